#include "viewer/viewer.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "base/error.h"
#include "gpu/error.h"
#include "gpu/presenter.h"
#include "pictures/compose.h"
#include "viewer/navigation.h"
#include "viewer/panels.h"
#include "viewer/picking.h"
#include "viewer/ratings_file.h"
#include "viewer/review_job.h"
#include "viewer/review_keys.h"
#include "viewer/reviewed_scene.h"
#include "window/interface_renderer.h"
#include "window/window.h"

namespace scene_analyzer::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kJobPoll = 0.1, kIdle = 3600;  // seconds
constexpr int kFramesAfterEvent = 3;            // ImGui answers an event one or two frames later
constexpr double kLongestStep = 0.1;            // seconds of movement per frame, also after a pause
constexpr float kClickPixels = 4;               // a pointer that moves less has clicked

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
      window_.wait_for_events(moving || frames_due_ > 0 ? 0 : status_.analysing ? kJobPoll : kIdle);
      // Whatever has ended the sleep, it may have changed what is to be seen.
      frames_due_ = moving || frames_due_ == 0 ? kFramesAfterEvent : frames_due_ - 1;
      if (status_.analysing) take_from_job();
      step();
      draw_frame();
    }
    refuse_wrong_use();
    return all_good_;
  }

 private:
  // What the validation layer says, where it is on.
  void refuse_wrong_use() {
    std::vector<std::string> messages = device_.take_validation_messages();
    for (std::string& message : job_.take_validation_messages()) messages.push_back(std::move(message));
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
    for (const ReviewJob::Finished& finished : job_.take_finished()) {
      for (const std::string& message : finished.messages) warn(message);
      if (!finished.error.empty()) {
        warn(finished.error);
        all_good_ = false;
        continue;
      }
      scene_.add(finished);
    }
    if (!done) return;
    status_.analysing = false;
    if (const auto failure = job_.failure()) {
      warn(*failure);
      all_good_ = false;
    }
    scene_.finish();
    state_ = initial_state(scene_.computed());
    if (scene_.rating().bounds)
      navigation_.show_all(*scene_.rating().bounds, aspect());
    else
      warn("there is nothing to look at: no triangle with a place in space");
  }

  // Of the part of the window that the panel leaves free.
  double aspect() const {
    const auto [width, height] = window_.pixels();
    return height == 0 ? 1 : (1 - panels_.share()) * width / height;
  }

  // What is at the target is in the middle of the free part.
  scene_render::Camera camera() const {
    const auto [width, height] = window_.pixels();
    scene_render::Camera camera = navigation_.camera();
    camera.middle[0] = -camera.tangent * panels_.share() * width / std::max(height, 1u);
    return camera;
  }

  void key_pressed(const window::KeyName& name) {
    const auto binding = std::ranges::find(key_bindings(), name, &KeyBinding::name);
    if (binding == key_bindings().end() || (interface_ && ImGui::GetIO().WantTextInput)) return;
    run_command(press(binding->key, state_));
  }

  void run_command(Command command) {
    if (command == Command::kQuit) window_.close();
    if (command == Command::kPrintKeys) options_.print(key_help(state_));
    if (!scene_.is_ready()) return;
    if (command == Command::kFrameAll) navigation_.show_all(*scene_.rating().bounds, aspect());
    if (command == Command::kFrameSelected && state_.selected && scene_.instance(*state_.selected).bounds)
      navigation_.frame(*scene_.instance(*state_.selected).bounds, aspect());
    try {
      if (command == Command::kWriteRatings)
        say("ratings are in " + write_ratings(scene_.report(), options_.folder).string());
      if (command == Command::kScreenshot) say("the picture is in " + write_screenshot().string());
    } catch (const InputError& error) {
      warn(error.what());
    }
  }

  std::filesystem::path write_screenshot() {
    const auto [width, height] = window_.pixels();
    const std::uint32_t rows = height - pictures::legend_height(width, height);
    const pictures::Content content = content_of(state_);
    const scene_render::Picture view =
        renderer_.draw(scene_.model(), navigation_.camera(), looks(), width, rows);
    return write_picture(
        pictures::compose(view, {}, pictures::make_legend(content, scene_.rating(), describe(state_)),
                          height),
        options_.folder);
  }

  std::vector<scene_render::Look> looks() {
    std::vector<scene_render::Look> looks = pictures::looks(content_of(state_), scene_.rating());
    for (scene_render::Look& look : looks) look.edges = state_.wireframe;
    if (state_.selected && *state_.selected < looks.size()) {
      looks[*state_.selected].edges = true;
      looks[*state_.selected].opacity = 1;
    }
    return looks;
  }

  void follow_mouse(std::uint32_t width, std::uint32_t height) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantCaptureMouse || !scene_.is_ready()) return;
    const double right = io.MouseDelta.x / io.DisplaySize.y, down = io.MouseDelta.y / io.DisplaySize.y;
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) navigation_.orbit(right, down);
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle))
      navigation_.pan(right, down);
    if (io.MouseWheel != 0) navigation_.zoom(io.MouseWheel);
    const ImVec2 dragged = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0);
    if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
        std::max(std::abs(dragged.x), std::abs(dragged.y)) < kClickPixels && io.MousePos.x >= 0 &&
        io.MousePos.y >= 0)
      pick(width, height, io.MousePos.x * io.DisplayFramebufferScale.x,
           io.MousePos.y * io.DisplayFramebufferScale.y);
  }

  void pick(std::uint32_t width, std::uint32_t height, float x, float y) {
    if (!picker_) picker_.emplace(device_);
    state_.selected = picker_->pick(scene_.model(), camera(), width, height, static_cast<std::uint32_t>(x),
                                    static_cast<std::uint32_t>(y));
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
    if (width == 0) {
      frames_due_ = 0;  // until the window is back
      return;
    }
    const auto begin = Clock::now();
    if (target_.width() != width || target_.height() != height)
      target_ = device_.make_render_target("window", width, height, samples_);
    interface_->begin_frame();
    follow_mouse(width, height);
    if (scene_.is_ready()) rate_anew();
    if (panels_.draw(scene_, state_, status_)) run_command(Command::kFrameSelected);
    gpu::Recorder recorder(device_);
    if (scene_.is_ready())
      renderer_.record(recorder, target_, scene_.model(), camera(), looks());
    else
      recorder.clear(target_, scene_render::kBackground, 0);
    interface_->record(recorder, target_);
    recorder.submit_and_wait();
    if (!presenter_.present(target_)) frames_due_ = kFramesAfterEvent;
    status_.frame_milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
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
  ReviewState state_;
  std::optional<ReviewState> rated_;
  std::optional<mesh::Vector3> rated_from_;
  Navigation navigation_;
  Panels panels_;
  Status status_;
  bool all_good_ = true;
  int frames_due_ = kFramesAfterEvent;
  Clock::time_point last_step_ = Clock::now();
  ReviewJob job_;  // last: it ends before what it was made from
};

}  // namespace

bool run_viewer(const ViewerOptions& options) {
  return Viewer(options).run();
}

}  // namespace scene_analyzer::viewer
