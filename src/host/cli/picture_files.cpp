#include "cli/picture_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/scene_loader.h"
#include "gpu/error.h"
#include "pictures/compose.h"
#include "pictures/far_away.h"
#include "scene_render/scene_renderer.h"

namespace scene_analyzer::cli {
namespace {

namespace fs = std::filesystem;
using pictures::Content;
using pictures::Subject;

constexpr std::uint32_t kSamples = 4;  // per pixel

struct PictureFile {
  fs::path path;
  Content content;
};

std::vector<PictureFile> picture_set(const PictureRequest& request, analysis::MetricSet metrics) {
  std::vector<PictureFile> files;
  const auto add = [&](const std::string& name, Content content) {
    files.push_back({*request.image_set / (name + ".png"), content});
  };
  const auto add_both = [&](const std::string& name, Content content) {
    content.relative = false;
    add(name, content);
    content.relative = true;
    add(name + "-relative", content);
  };
  Content content = request.content;
  content.subject = Subject::kAggregate;
  add_both("aggregate", content);
  content.subject = Subject::kMetric;
  for (std::size_t i = 0; i < analysis::kMetricCount; ++i) {
    if (!metrics[i]) continue;
    content.metric = static_cast<analysis::Metric>(i);
    add_both(std::string(analysis::kMetricKeys[i]), content);
  }
  content.emphasize_extremes = content.relative = false;
  content.subject = Subject::kPlanarGroups;
  add("planar_groups", content);
  content.subject = Subject::kOwnColors;
  add("own_colours", content);
  return files;
}

std::vector<PictureFile> wanted_files(const PictureRequest& request, analysis::MetricSet metrics) {
  std::vector<PictureFile> files;
  if (request.image_set) files = picture_set(request, metrics);
  if (request.image) files.insert(files.begin(), {*request.image, request.content});
  return files;
}

std::string scene_name(const report::SceneReport& report) {
  const std::string first = fs::path(report.assets.front().asset).filename().string();
  if (report.assets.size() == 1) return first;
  return fmt::format("{} and {} more", first, report.assets.size() - 1);
}

// Whether `work` was done; if not, the log says what is lost and why. One picture's failure is not the
// others'.
bool attempt(const std::string& lost, Progress& progress, const std::function<void()>& work) {
  const auto say = [&](const std::string& why) {
    progress.aside([&] { log_error(fmt::format("{}: {}", lost, why)); });
    return false;
  };
  try {
    work();
    return true;
  } catch (const gpu::DeviceLost&) {
    throw;
  } catch (const gpu::OutOfMemory& error) {
    return say(fmt::format("{}; try a smaller --size or fewer assets", error.what()));
  } catch (const std::bad_alloc&) {
    return say("this machine has too little free memory; try a smaller --size or fewer assets");
  } catch (const std::runtime_error& error) {
    check_interrupt();  // Ctrl-C reaches the import worker too
    return say(error.what());
  }
}

class Studio {
 public:
  Studio(const AnalyzeRequest& request, const report::SceneReport& report, gpu::Device& device)
      : request_(request),
        report_(report),
        files_(wanted_files(request.pictures, request.ratings.metrics)),
        progress_(request.log != LogLevel::kQuiet, report.assets.size() + files_.size()),
        device_(device) {}

  bool write_all() {
    if (!attempt("no picture is drawn", progress_, [&] { load(); })) return false;
    for (std::size_t i = 0; i < files_.size(); ++i) {
      check_interrupt();
      const std::size_t item = report_.assets.size() + i;
      progress_.start_asset(item, files_[i].path.filename().string());
      progress_.update(item, 0, "picture");
      good_ = attempt(fmt::format("{} is not drawn", files_[i].path.string()), progress_,
                      [&] { report::write_file(files_[i].path, draw(files_[i].content)); }) &&
              good_;
      progress_.finish_asset(item);
    }
    return good_;
  }

 private:
  void load() {
    renderer_.emplace(device_, kSamples);
    const bool groups = std::ranges::any_of(
        files_, [](const PictureFile& file) { return file.content.subject == Subject::kPlanarGroups; });
    SceneLoader loader(device_, request_.pipeline.import_limits);
    for (std::size_t i = 0; i < report_.assets.size(); ++i) {
      progress_.start_asset(i, fs::path(report_.assets[i].asset).filename().string());
      loader.add(report_.assets[i], groups && renderer_->can_draw_groups(),
                 [&](double fraction, const std::string& step) {
                   check_interrupt();
                   progress_.update(i, fraction, step);
                 });
      progress_.aside([&] {
        for (const std::string& warning : loader.take_warnings()) log_warning(warning);
      });
      progress_.finish_asset(i);
    }
    if (groups && !renderer_->can_draw_groups())
      progress_.aside([] {
        log_warning(
            "the device cannot draw planar groups (geometryShader is missing): all meshes are grey there");
      });
    model_ = loader.finish();
    progress_.aside([&] {
      for (const std::string& warning : loader.take_warnings()) log_warning(warning);
    });
    frame();
  }

  // What the pictures show: the scene as it was analysed, and meshes that were beyond a limit then.
  void frame() {
    bounds_ = report_.rating.bounds;
    for (std::size_t i = 0; i < report_.rating.meshes.size(); ++i) {
      const ratings::MeshRating& mesh = report_.rating.meshes[i];
      const analysis::AssetAnalysis& asset = report_.assets[mesh.asset];
      const auto box = model_->box(i);
      if (!box || asset.geometries[asset.instances[mesh.instance].geometry].not_analysed.empty()) continue;
      if (!bounds_) bounds_ = box;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        bounds_->min[axis] = std::min(bounds_->min[axis], box->min[axis]);
        bounds_->max[axis] = std::max(bounds_->max[axis], box->max[axis]);
      }
    }
    if (!bounds_) throw InputError("the scene has no triangle with a place in space");
    if (request_.pictures.target) return;
    if (const auto far = pictures::find_far_away(*model_))
      progress_.aside([&] {
        const auto text = [](const mesh::Vector3& point) {
          return fmt::format("{:.6g},{:.6g},{:.6g}", point[0], point[1], point[2]);
        };
        log_warning(
            fmt::format("{} lies so far from the other meshes that most of these are smaller than a pixel; "
                        "choose what is seen, for example with --eye {} --target {}",
                        name_of(far->mesh), text(far->eye), text(far->others)));
      });
  }

  std::string name_of(std::size_t row) const {
    const ratings::MeshRating& mesh = report_.rating.meshes[row];
    const analysis::InstanceAnalysis& instance = report_.assets[mesh.asset].instances[mesh.instance];
    return fmt::format("mesh {} ({})", row, instance.node.empty() ? instance.mesh : instance.node);
  }

  // The aggregate depends on the mode; single ratings are there in both.
  const ratings::SceneRating& rating_of(const Content& content) {
    if (content.subject != Subject::kAggregate || content.relative == request_.ratings.relative)
      return report_.rating;
    if (!other_mode_) {
      ratings::Options options = request_.ratings;
      options.relative = content.relative;
      other_mode_ = ratings::rate(report_.assets, options);
    }
    return *other_mode_;
  }

  std::string draw(const Content& content) {
    const ratings::SceneRating& rating = rating_of(content);
    const PictureRequest& pictures = request_.pictures;
    const std::uint32_t legend_rows = pictures::legend_height(pictures.width, pictures.height);
    const std::uint32_t rows = pictures.height - legend_rows;
    const scene_render::Camera camera = scene_render::make_camera(
        *bounds_, request_.ratings.eye, pictures.target, static_cast<double>(pictures.width) / rows);
    renderer_->set_group_colors(content.map);
    const scene_render::Picture view =
        renderer_->draw(*model_, camera, pictures::looks(content, rating), pictures.width, rows);
    const auto marks =
        pictures::mark_small_extremes(content, rating, report_.assets, camera, pictures.width, rows,
                                      pictures::mark_radius(pictures.width, pictures.height));
    pictures::Legend legend = pictures::make_legend(content, rating, scene_name(report_));
    if (content.subject == Subject::kPlanarGroups) legend.without_value = has_unknown_groups();
    return pictures::compose(view, marks, legend, pictures.height);
  }

  bool has_unknown_groups() const {
    if (!renderer_->can_draw_groups()) return true;
    for (std::size_t i = 0; i < model_->size(); ++i)
      if (model_->box(i) && !model_->instance(i).groups) return true;
    return false;
  }

  const AnalyzeRequest& request_;
  const report::SceneReport& report_;
  const std::vector<PictureFile> files_;
  bool good_ = true;
  Progress progress_;
  gpu::Device& device_;
  std::optional<scene_render::SceneRenderer> renderer_;
  std::optional<scene_render::SceneModel> model_;
  std::optional<analysis::Bounds> bounds_;
  std::optional<ratings::SceneRating> other_mode_;
};

}  // namespace

bool write_pictures(const AnalyzeRequest& request, const report::SceneReport& report, LazyDevice& device) {
  if (!request.pictures.wanted() || report.assets.empty()) return true;
  return Studio(request, report, device.get()).write_all();
}

}  // namespace scene_analyzer::cli
