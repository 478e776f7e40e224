#include "viewer/viewer.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <utility>

#include "base/error.h"
#include "gpu/error.h"
#include "gpu/presenter.h"
#include "viewer/frame_times.h"
#include "viewer/mouse.h"
#include "viewer/navigation.h"
#include "viewer/panels.h"
#include "viewer/picking.h"
#include "viewer/ratings_file.h"
#include "viewer/review_job.h"
#include "viewer/review_keys.h"
#include "viewer/reviewed_scene.h"
#include "viewer/selection_panel.h"
#include "viewer/signal_job.h"
#include "viewer/view_pictures.h"
#include "window/interface_renderer.h"
#include "window/window.h"

namespace scene_analyzer::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kJobPoll = 0.1, kIdle = 3600;  // seconds
constexpr int kFramesAfterEvent = 3;            // ImGui answers an event one or two frames later
constexpr double kLongestStep = 0.1;            // seconds of movement per frame, also after a pause

gpu::DeviceOptions with_surface(gpu::DeviceOptions options, const window::Window& window) {
  options.surface_extensions = window.surface_extensions();
  return options;
}

// Software devices would need several times as long for smooth edges.
std::uint32_t samples_for(const gpu::Device& device) {
  return device.info().type == gpu::DeviceType::kCpu ? 1 : 4;
}

class Viewer {
 public:
  explicit Viewer(const ViewerOptions& options)
      : options_(options),
        window_("Scene Analyzer", options.width, options.height),
        device_(with_surface(options.device, window_)),
        samples_(samples_for(device_)),
        presenter_(device_, window_.surface_maker()),
        renderer_(device_, samples_),
        scene_(device_),
        signal_job_(options.device, options.pipeline.import_limits, window::Window::wake),
        job_(options.assets, options.pipeline, options.device, window::Window::wake) {
    // Before ImGui, which passes on to those who came first.
    window_.on_key([this](const window::KeyName& name) { key_pressed(name); });
    interface_.emplace(device_, window_, samples_);
    status_.edges_can_be_drawn = renderer_.can_draw_edges();
    status_.groups_can_be_drawn = renderer_.can_draw_groups();
  }

  bool run() {
    while (!window_.should_close()) {
      const bool moving = motion() != Motion{};
      slept_ = not_shown_ || (!moving && frames_due_ == 0);
      window_.wait_for_events(not_shown_ ? kJobPoll : !slept_ ? 0 : status_.analysing ? kJobPoll : kIdle);
      // Whatever has ended the sleep, it may have changed what is to be seen.
      frames_due_ = moving || frames_due_ == 0 ? kFramesAfterEvent : frames_due_ - 1;
      if (status_.analysing) take_from_job();
      step();
      draw_frame();
    }
    if (const auto summary = frame_times_.summary()) options_.tell(*summary);
    refuse_wrong_use();
    return all_good_;
  }

 private:
  // What the validation layer says, where it is on.
  void refuse_wrong_use() {
    std::vector<std::string> messages = device_.take_validation_messages();
    std::ranges::move(job_.take_validation_messages(), std::back_inserter(messages));
    std::ranges::move(signal_job_.take_validation_messages(), std::back_inserter(messages));
    for (const std::string& message : messages) options_.warn(message);
    if (!messages.empty()) throw gpu::Error("the device was used wrongly, see the messages above");
  }

  Motion motion() const {
    std::set<Key> held;
    for (const KeyBinding& binding : key_bindings())
      if (window_.held().contains(std::string(binding.name))) held.insert(binding.key);
    return motion_of(held);
  }

  void step() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_step_).count();
    last_step_ = now;
    if (scene_.is_ready()) navigation_.advance(motion(), std::min(seconds, kLongestStep));
  }

  void say(const std::string& message) {
    status_.messages.push_back(message);
    options_.print(message + "\n");
  }

  void warn(const std::string& message) {
    status_.messages.push_back(message);
    options_.warn(message);
  }

  void take_from_job() {
    status_.job = job_.progress();
    const bool done = job_.done();  // asked first: what was finished before is taken below
    if (const auto finished = job_.take_finished(); !finished.empty()) show(finished);
    if (done) end_of_job();
  }

  // The view stays where somebody has gone; before that, all of the scene is in view.
  void show(const std::vector<ReviewJob::Finished>& assets) {
    const bool untouched = navigation_.eye() == shown_from_ || !scene_.is_ready();
    const ReviewedScene::Arrived arrived = scene_.add(assets);
    for (const std::string& message : arrived.messages) warn(message);
    all_good_ = all_good_ && arrived.all_good;
    rated_.reset();
    extend(state_, scene_.computed());
    if (!scene_.is_ready()) return;
    navigation_.extend(*scene_.rating().bounds);
    if (untouched) navigation_.show_all(*scene_.rating().bounds, aspect());
    if (untouched) shown_from_ = navigation_.eye();
  }

  void end_of_job() {
    status_.analysing = false;
    if (const auto failure = job_.failure()) {
      warn(*failure);
      all_good_ = false;
    }
    if (!scene_.is_ready()) warn("there is nothing to look at: no triangle with a place in space");
  }

  // Of the part of the window that the panel leaves free.
  double aspect() const {
    const auto [width, height] = window_.pixels();
    return height == 0 ? 1 : (1 - panels_.share()) * width / height;
  }

  scene_render::Camera camera() const {
    const auto [width, height] = window_.pixels();
    return beside_panel(navigation_.camera(), panels_.share(), width, height);
  }

  void key_pressed(const window::KeyName& name) {
    const auto binding = std::ranges::find(key_bindings(), name, &KeyBinding::name);
    if (binding == key_bindings().end() || (interface_ && ImGui::GetIO().WantTextInput)) return;
    run_command(press(binding->key, state_));
  }

  void run_command(Command command) {
    if (command == Command::kQuit) window_.close();
    if (command == Command::kPrintKeys) options_.print(key_help(state_));
    // Files show what is chosen now, so they wait for the next frame, which rates it.
    if (command == Command::kPictureOfWindow) window_picture_due_ = true;
    if (!scene_.is_ready()) return;
    if (command == Command::kPictureOfScene) scene_picture_due_ = true;
    if (command == Command::kWriteRatings) ratings_due_ = true;
    if (command == Command::kFrameAll) navigation_.show_all(*scene_.rating().bounds, aspect());
    if (command == Command::kFrameSelected && state_.selected && scene_.instance(*state_.selected).bounds)
      navigation_.frame(*scene_.instance(*state_.selected).bounds, aspect());
  }

  void write_ratings_file() {
    say("ratings are in " + write_ratings(scene_.report(), options_.folder).string());
  }

  void write_scene() {
    const auto [width, height] = window_.pixels();
    const std::string png = picture_of_scene(renderer_, scene_, state_, navigation_.camera(), width, height);
    say("the picture is in " + write_numbered(options_.folder, "scene-picture-", ".png", png).string());
  }

  // What the last frame has drawn.
  void write_window() {
    const std::string png = picture_of_window(device_, target_);
    say("the window is in " + write_numbered(options_.folder, "scene-window-", ".png", png).string());
  }

  // A file that cannot be written ends nothing.
  void attempt(void (Viewer::*write)()) {
    try {
      (this->*write)();
    } catch (const InputError& error) {
      warn(error.what());
    } catch (const gpu::OutOfMemory& error) {
      warn(error.what());
    }
  }

  void pick(std::uint32_t x, std::uint32_t y) {
    if (!picker_) picker_.emplace(device_);
    const auto [width, height] = window_.pixels();
    state_.selected = picker_->pick(scene_.model(), camera(), width, height, x, y);
  }

  void draw_selection() {
    const std::size_t row = *state_.selected;
    const auto wanted = signal_of(scene_, row);
    wanted ? signal_job_.ask(*wanted, scene_.assets()[wanted->asset]) : signal_job_.give_up();
    draw_selected(scene_, row, signal_job_.state(), camera());
  }

  // Ratings follow the eye and what was chosen.
  void rate_anew() {
    ReviewState chosen = state_;
    chosen.selected.reset();
    if (rated_ == chosen && rated_from_ == navigation_.eye()) return;
    rated_ = chosen;
    rated_from_ = navigation_.eye();
    scene_.rate(rating_options(state_, *rated_from_));
    renderer_.set_group_colors(state_.map);
    window_.set_title("Scene Analyzer: " + describe(state_));
  }

  void draw_frame() {
    const auto [width, height] = window_.pixels();
    if (width == 0 || (not_shown_ && !presenter_.has_pixels())) {
      frames_due_ = 0;  // until the window is back
      return;
    }
    if (target_.width() != width || target_.height() != height)
      target_ = device_.make_render_target("window", width, height, samples_);
    interface_->begin_frame();
    if (scene_.is_ready()) {
      if (const auto clicked = follow_mouse(navigation_)) pick(clicked->first, clicked->second);
      rate_anew();
      if (std::exchange(ratings_due_, false)) attempt(&Viewer::write_ratings_file);
      if (std::exchange(scene_picture_due_, false)) attempt(&Viewer::write_scene);
    }
    if (panels_.draw(scene_, state_, status_)) run_command(Command::kFrameSelected);
    state_.selected ? draw_selection() : signal_job_.give_up();
    gpu::Recorder recorder(device_);
    if (scene_.is_ready())
      renderer_.record(recorder, target_, scene_.model(), camera(), looks_of(state_, scene_.rating()));
    else
      recorder.clear(target_, scene_render::kBackground, 0);
    interface_->record(recorder, target_);
    recorder.submit_and_wait();
    if (std::exchange(window_picture_due_, false)) attempt(&Viewer::write_window);
    not_shown_ = !presenter_.present(target_);
    if (not_shown_)
      frames_due_ = kFramesAfterEvent;
    else
      frame_times_.shown(std::chrono::duration<double>(Clock::now().time_since_epoch()).count(), !slept_);
    status_.frame_milliseconds = frame_times_.last_milliseconds();
  }

  const ViewerOptions& options_;
  window::Window window_;
  gpu::Device device_;
  const std::uint32_t samples_;
  gpu::Presenter presenter_;
  scene_render::SceneRenderer renderer_;
  std::optional<window::InterfaceRenderer> interface_;
  std::optional<Picker> picker_;
  gpu::RenderTarget target_;
  ReviewedScene scene_;
  ReviewState state_ = initial_state({});
  std::optional<ReviewState> rated_;
  std::optional<mesh::Vector3> rated_from_, shown_from_;
  Navigation navigation_;
  Panels panels_;
  Status status_;
  FrameTimes frame_times_;
  bool all_good_ = true, slept_ = false, window_picture_due_ = false, scene_picture_due_ = false,
       ratings_due_ = false;
  int frames_due_ = kFramesAfterEvent;
  bool not_shown_ = false;  // the last frame: tried again, but not as fast as possible
  Clock::time_point last_step_ = Clock::now();
  SignalJob signal_job_;
  ReviewJob job_;  // last: it ends before what it was made from
};

}  // namespace

bool run_viewer(const ViewerOptions& options) {
  return Viewer(options).run();
}

}  // namespace scene_analyzer::viewer
