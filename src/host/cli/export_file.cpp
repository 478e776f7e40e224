#include "cli/export_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "base/error.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "pipeline/import_again.h"
#include "report/glb.h"

namespace scene_analyzer::cli {
namespace {

std::vector<std::optional<ratings::Rgb>> colors_of(const pictures::Content& content,
                                                   const ratings::SceneRating& rating) {
  const bool is_signed = pictures::is_signed(content, rating);
  std::vector<std::optional<ratings::Rgb>> colors;
  for (const std::optional<double>& value : pictures::values(content, rating))
    colors.push_back(value ? std::optional(ratings::color(*value, content.map, is_signed)) : std::nullopt);
  return colors;
}

std::string make_glb(const AnalyzeRequest& request, const report::SceneReport& report) {
  Progress progress(request.log != LogLevel::kQuiet, report.assets.size() + 1);
  std::vector<mesh::Scene> scenes;
  for (std::size_t i = 0; i < report.assets.size(); ++i) {
    check_interrupt();
    progress.start_asset(i, std::filesystem::path(report.assets[i].asset).filename().string());
    progress.update(i, 0, "import for export");
    scenes.push_back(
        pipeline::import_again(report.assets[i], request.pipeline.import_limits, import::Textures::kLeave));
    progress.finish_asset(i);
  }
  progress.start_asset(scenes.size(), request.export_file->filename().string());
  progress.update(scenes.size(), 0, "export");
  std::vector<const mesh::Scene*> pointers;
  for (const mesh::Scene& scene : scenes) pointers.push_back(&scene);
  return report::glb(report, pointers, colors_of(request.pictures.content, report.rating));
}

}  // namespace

bool write_export(const AnalyzeRequest& request, const report::SceneReport& report) {
  if (!request.export_file || report.assets.empty()) return true;
  try {
    report::write_file(*request.export_file, make_glb(request, report));
    return true;
  } catch (const InputError& error) {
    check_interrupt();  // Ctrl-C reaches the import worker too
    log_error(fmt::format("{} is not written: {}", request.export_file->string(), error.what()));
    return false;
  }
}

}  // namespace scene_analyzer::cli
