#include "library/load_record.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "analysis_file/analysis_file.h"
#include "base/error.h"
#include "library/library_times.h"

namespace scene_analyzer::library {
namespace {

// A record is a file's, and a file may say anything: what it names has to lie below the folder of analyses.
bool leads_out(const std::filesystem::path& path) {
  const std::filesystem::path normal = path.lexically_normal();
  return normal.empty() || normal.is_absolute() || *normal.begin() != "analyses";
}

}  // namespace

std::variant<analysis::AssetAnalysis, std::string> load_record(const std::filesystem::path& folder,
                                                               const Record& record,
                                                               const Manifest& manifest) {
  const auto because = [&](const std::string& reason) {
    return fmt::format("{}: its analysis file '{}' {}", record.asset, record.analysis, reason);
  };
  if ((manifest.metrics & ~record.metrics).any()) return because("lacks metrics that are asked for now");
  if (leads_out(record.analysis)) return because("is not in the library's folder");
  auto loaded = analysis_file::load(folder / record.analysis);
  if (const auto* unusable = std::get_if<analysis_file::Unusable>(&loaded)) return because(unusable->reason);
  auto& analysis = std::get<analysis::AssetAnalysis>(loaded);
  if (analysis_file::content_key(analysis) != record.content_key)
    return because("is not the one that the journal names");
  analysis::Parameters wanted = manifest.parameters;
  if (!analysis.computed[index_of(analysis::Metric::kFourierTransform)])
    wanted.start_searches = analysis.parameters.start_searches;
  wanted.steps = analysis.parameters.steps;  // those of rendering times are kept with them
  if (analysis.parameters != wanted) return because("was made under other options");
  std::erase_if(analysis.timings, [&](const analysis::RenderTiming& timing) {
    const auto& under = timing.conditions;
    return under.width != manifest.timing_width || under.height != manifest.timing_height ||
           under.steps != manifest.parameters.steps;
  });
  analysis.asset = record.asset;
  return std::move(analysis);
}

analysis::AssetAnalysis load_merged(const std::filesystem::path& folder, const Merged& merged,
                                    std::size_t asset) {
  auto loaded = load_record(folder, merged.assets[asset], merged.manifest);
  if (const auto* reason = std::get_if<std::string>(&loaded)) throw InputError(*reason);
  auto& analysis = std::get<analysis::AssetAnalysis>(loaded);
  keep_times(analysis, merged.timing);
  return std::move(analysis);
}

}  // namespace scene_analyzer::library
