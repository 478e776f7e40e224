#include "cli/picture_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "gpu/error.h"
#include "pictures/scene_loader.h"
#include "pictures/scene_studio.h"

namespace scene_analyzer::cli {
namespace {

namespace fs = std::filesystem;
using pictures::Content;
using pictures::Subject;

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

class PictureWriter {
 public:
  PictureWriter(const AnalyzeRequest& request, const report::SceneReport& report, gpu::Device& device)
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
                      [&] { report::write_file(files_[i].path, studio_->draw(files_[i].content)); }) &&
              good_;
      progress_.finish_asset(item);
    }
    return good_;
  }

 private:
  void load() {
    studio_.emplace(device_, pictures::RatedScene{report_.assets, report_.rating, request_.ratings},
                    request_.pictures.format);
    const bool groups = std::ranges::any_of(
        files_, [](const PictureFile& file) { return file.content.subject == Subject::kPlanarGroups; });
    pictures::SceneLoader loader(device_, request_.pipeline.import_limits);
    for (std::size_t i = 0; i < report_.assets.size(); ++i) {
      progress_.start_asset(i, fs::path(report_.assets[i].asset).filename().string());
      loader.add(report_.assets[i], groups && studio_->can_draw_groups(),
                 [&](double fraction, const std::string& step) {
                   check_interrupt();
                   progress_.update(i, fraction, step);
                 });
      progress_.aside([&] {
        for (const std::string& warning : loader.take_warnings()) log_warning(warning);
      });
      progress_.finish_asset(i);
    }
    if (groups && !studio_->can_draw_groups())
      progress_.aside([] {
        log_warning(
            "the device cannot draw planar groups (geometryShader is missing): all meshes are grey there");
      });
    scene_render::SceneModel model = loader.finish();
    progress_.aside([&] {
      for (const std::string& warning : loader.take_warnings()) log_warning(warning);
    });
    studio_->set_model(std::move(model));
    warn_about_far_away();
  }

  void warn_about_far_away() {
    const auto far = studio_->far_away();
    if (!far) return;
    progress_.aside([&] {
      const auto text = [](const mesh::Vector3& point) {
        return fmt::format("{:.6g},{:.6g},{:.6g}", point[0], point[1], point[2]);
      };
      log_warning(
          fmt::format("{} lies so far from the other meshes that most of these are smaller than a pixel; "
                      "choose what is seen, for example with --eye {} --target {}",
                      studio_->name_of(far->mesh), text(far->eye), text(far->others)));
    });
  }

  const AnalyzeRequest& request_;
  const report::SceneReport& report_;
  const std::vector<PictureFile> files_;
  bool good_ = true;
  Progress progress_;
  gpu::Device& device_;
  std::optional<pictures::SceneStudio> studio_;
};

}  // namespace

bool write_pictures(const AnalyzeRequest& request, const report::SceneReport& report, LazyDevice& device) {
  if (!request.pictures.wanted() || report.assets.empty()) return true;
  return PictureWriter(request, report, device.get()).write_all();
}

}  // namespace scene_analyzer::cli
