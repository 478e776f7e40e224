// merged_json.cpp — The summary of a library as JSON.
#include <algorithm>
#include <cmath>

#include "analysis_file/hash.h"
#include "library/json_text.h"
#include "library/merge.h"

namespace scene_analyzer::library {
namespace {

using analysis::kMetricCount;
using analysis::kMetricKeys;
using nlohmann::ordered_json;

constexpr std::size_t kMostListed = 1000;  // assets that were not analysed; their number is never cut
constexpr std::size_t kMostHolders = 8;    // assets named that hold one duplicate

ordered_json number(std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return nullptr;
  return *value + 0.0;  // -0 + 0 = 0
}

ordered_json distribution(std::vector<double> values) {
  const Distribution shape = distribution_of(std::move(values));
  if (shape.count == 0) return nullptr;
  return {{"count", shape.count},
          {"mean", number(shape.mean)},
          {"minimum", number(shape.least)},
          {"quantile_05", number(shape.quantiles[0])},
          {"quantile_25", number(shape.quantiles[1])},
          {"median", number(shape.quantiles[2])},
          {"quantile_75", number(shape.quantiles[3])},
          {"quantile_95", number(shape.quantiles[4])},
          {"maximum", number(shape.greatest)}};
}

template <typename Value>
std::vector<double> values_of(std::size_t count, Value value) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
    if (const std::optional<double> one = value(i)) values.push_back(*one);
  return values;
}

ordered_json distributions(const Merged& merged) {
  const std::size_t count = merged.meshes.size();
  ordered_json ratings = ordered_json::object();
  for (std::size_t key = 0; key < kMetricCount; ++key)
    ratings[std::string(kMetricKeys[key])] =
        distribution(values_of(count, [&](std::size_t i) { return merged.ratings[i][key]; }));
  return {
      {"ratings", std::move(ratings)},
      {"aggregate", distribution(values_of(count, [&](std::size_t i) { return merged.aggregates[i]; }))},
      {"triangles", distribution(values_of(count,
                                           [&](std::size_t i) -> std::optional<double> {
                                             return static_cast<double>(merged.meshes[i].triangles);
                                           }))},
      {"density", distribution(values_of(count, [&](std::size_t i) { return merged.meshes[i].density; }))},
      {"rendering_time_ns",
       distribution(values_of(count, [&](std::size_t i) { return merged.meshes[i].time_ns; }))}};
}

ordered_json top_of(const Merged& merged, const std::vector<Offender>& offenders) {
  ordered_json list = ordered_json::array();
  for (const Offender& offender : offenders) {
    const MergedMesh& mesh = merged.meshes[offender.mesh];
    list.push_back({{"index", offender.mesh},
                    {"asset", merged.assets[mesh.asset].asset},
                    {"node", offender.node},
                    {"mesh", offender.name},
                    {"triangles", mesh.triangles},
                    {"value", number(offender.value)},
                    {"others_like_it", offender.others}});
  }
  return list;
}

ordered_json top(const Merged& merged, const Offenders& offenders) {
  ordered_json lists = ordered_json::object();
  for (std::size_t key = 0; key < kMetricCount; ++key)
    lists[std::string(kMetricKeys[key])] = top_of(merged, offenders[key]);
  lists["aggregate"] = top_of(merged, offenders[kMetricCount]);
  return lists;
}

ordered_json duplicates(const Merged& merged, std::size_t count) {
  std::uint64_t redundant = 0;
  for (const Duplicate& one : merged.duplicates) redundant += one.redundant_triangles();
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < std::min(count, merged.duplicates.size()); ++i) {
    const Duplicate& one = merged.duplicates[i];
    ordered_json holders = ordered_json::array();
    for (std::size_t k = 0; k < std::min(kMostHolders, one.assets.size()); ++k)
      holders.push_back(merged.assets[one.assets[k]].asset);
    list.push_back({{"shape_hash", analysis_file::to_hex(one.shape_hash)},
                    {"triangles", one.triangles},
                    {"asset_count", one.assets.size()},
                    {"redundant_triangles", one.redundant_triangles()},
                    {"first_assets", std::move(holders)}});
  }
  return {{"shapes", merged.duplicates.size()}, {"redundant_triangles", redundant}, {"top", std::move(list)}};
}

ordered_json defects(const Merged& merged) {
  ordered_json totals = ordered_json::object();
  for (std::size_t kind = 0; kind < analysis::kDefectCount; ++kind)
    totals[std::string(analysis::kDefectKeys[kind])] = {{"meshes", merged.defects[kind].meshes},
                                                        {"count", merged.defects[kind].count}};
  return totals;
}

ordered_json assets(const Merged& merged) {
  const auto incomplete = std::ranges::count(merged.not_analysed, Status::kIncomplete, &Record::status);
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < std::min(kMostListed, merged.not_analysed.size()); ++i) {
    const Record& record = merged.not_analysed[i];
    list.push_back({{"asset", record.asset},
                    {"status", kStatusKeys[static_cast<std::size_t>(record.status)]},
                    {"reason", record.reason}});
  }
  return {{"analysed", merged.assets.size()},
          {"incomplete", incomplete},
          {"failed", merged.not_analysed.size() - static_cast<std::size_t>(incomplete)},
          {"missing", merged.missing.size()},
          {"bytes", merged.bytes},
          {"not_analysed", std::move(list)}};
}

ordered_json parameters(const Manifest& manifest) {
  ordered_json metrics = ordered_json::array();
  for (std::size_t i = 0; i < kMetricCount; ++i)
    if (manifest.metrics[i]) metrics.push_back(std::string(kMetricKeys[i]));
  return {{"alpha", manifest.parameters.alpha_degrees},
          {"dim", manifest.parameters.dim},
          {"steps", manifest.parameters.steps},
          {"start_searches", manifest.parameters.start_searches},
          {"weld_tolerance", manifest.parameters.weld_tolerance},
          {"metrics", std::move(metrics)}};
}

ordered_json timing(const Merged& merged) {
  if (!merged.timing) return nullptr;
  return {{"device", merged.timing->device.name},
          {"driver", merged.timing->device.driver},
          {"device_type", merged.timing->device.type},
          {"device_count", merged.timing_devices},
          {"width", merged.timing->width},
          {"height", merged.timing->height},
          {"steps", merged.timing->steps}};
}

}  // namespace

std::string summary_json(const Merged& merged, const Offenders& offenders, std::size_t count) {
  const ordered_json document = {{"schema_version", 1},
                                 {"tool", {{"version", merged.manifest.tool_version}}},
                                 {"parameters", parameters(merged.manifest)},
                                 {"assets", assets(merged)},
                                 {"meshes",
                                  {{"count", merged.meshes.size()},
                                   {"unique_triangles", merged.unique_triangles},
                                   {"drawn_triangles", merged.drawn_triangles},
                                   {"degenerate_triangles", merged.degenerate_triangles}}},
                                 {"render_timing", timing(merged)},
                                 {"mixed_timings", merged.mixed_timings},
                                 {"density_mean", number(merged.density_mean)},
                                 {"density_deviation", number(merged.density_deviation)},
                                 {"distributions", distributions(merged)},
                                 {"top", top(merged, offenders)},
                                 {"duplicates", duplicates(merged, count)},
                                 {"defects", defects(merged)}};
  return document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace scene_analyzer::library
