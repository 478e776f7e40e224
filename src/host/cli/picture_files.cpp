#include "cli/picture_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "cli/interrupt.h"
#include "cli/mesh_files.h"
#include "cli/progress.h"
#include "cli/scene_loader.h"
#include "gpu/error.h"
#include "pictures/compose.h"
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

class Studio {
 public:
  Studio(const AnalyzeRequest& request, const report::SceneReport& report, gpu::Device& device)
      : request_(request),
        report_(report),
        files_(wanted_files(request.pictures, request.ratings.metrics)),
        progress_(request.log != LogLevel::kQuiet, report.assets.size() + files_.size()),
        renderer_(device, kSamples),
        model_(load(device)) {}

  bool write_all() {
    for (std::size_t i = 0; i < files_.size(); ++i) {
      check_interrupt();
      const std::size_t item = report_.assets.size() + i;
      progress_.start_asset(item, files_[i].path.filename().string());
      progress_.update(item, 0, "picture");
      try {
        report::write_file(files_[i].path, draw(files_[i].content));
      } catch (const InputError& error) {
        progress_.aside([&] { log_error(error.what()); });
        good_ = false;
      }
      progress_.finish_asset(item);
    }
    return good_;
  }

 private:
  scene_render::SceneModel load(gpu::Device& device) {
    const bool groups = std::ranges::any_of(
        files_, [](const PictureFile& file) { return file.content.subject == Subject::kPlanarGroups; });
    SceneLoader loader(device, request_.pipeline.import_limits);
    for (std::size_t i = 0; i < report_.assets.size(); ++i) {
      progress_.start_asset(i, fs::path(report_.assets[i].asset).filename().string());
      loader.add(report_.assets[i], groups && renderer_.can_draw_groups(),
                 [&](double fraction, const std::string& step) {
                   check_interrupt();
                   progress_.update(i, fraction, step);
                 });
      progress_.finish_asset(i);
    }
    if (groups && !renderer_.can_draw_groups())
      progress_.aside([] {
        log_warning(
            "the device cannot draw planar groups (geometryShader is missing): all meshes are grey there");
      });
    return loader.finish();
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
        *rating.bounds, request_.ratings.eye, pictures.target, static_cast<double>(pictures.width) / rows);
    renderer_.set_group_colors(content.map);
    const scene_render::Picture view =
        renderer_.draw(model_, camera, pictures::looks(content, rating), pictures.width, rows);
    const auto marks =
        pictures::mark_small_extremes(content, rating, report_.assets, camera, pictures.width, rows,
                                      pictures::mark_radius(pictures.width, pictures.height));
    return pictures::compose(view, marks, pictures::make_legend(content, rating, scene_name(report_)),
                             pictures.height);
  }

  const AnalyzeRequest& request_;
  const report::SceneReport& report_;
  const std::vector<PictureFile> files_;
  bool good_ = true;
  Progress progress_;
  scene_render::SceneRenderer renderer_;
  scene_render::SceneModel model_;
  std::optional<ratings::SceneRating> other_mode_;
};

}  // namespace

bool write_pictures(const AnalyzeRequest& request, const report::SceneReport& report, LazyDevice& device) {
  if (!request.pictures.wanted() || report.assets.empty()) return true;
  if (request.pictures.image_set) make_folder("image-set", *request.pictures.image_set);
  if (!report.rating.bounds) {
    log_error("no picture is drawn: the scene has no triangle with a place in space");
    return false;
  }
  try {
    return Studio(request, report, device.get()).write_all();
  } catch (const InputError& error) {
    log_error(fmt::format("no picture is drawn: {}", error.what()));
  } catch (const gpu::OutOfMemory& error) {
    log_error(fmt::format("no picture is drawn: {}; try a smaller --size or fewer assets", error.what()));
  }
  return false;
}

}  // namespace scene_analyzer::cli
