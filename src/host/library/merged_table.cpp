// merged_table.cpp — The summary of a library for people.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "library/merge.h"
#include "report/terminal_text.h"

namespace scene_analyzer::library {
namespace {

using analysis::kMetricCount;
using analysis::kMetricKeys;

constexpr std::size_t kLeastWidth = 40, kDefaultWidth = 120;
constexpr std::size_t kMostAssetsShown = 10;  // that were not analysed
constexpr double kMebi = 1 << 20;

std::size_t width_of(const report::TableStyle& style) {
  return std::max(kLeastWidth, style.width == 0 ? kDefaultWidth : style.width);
}

std::string fit(const std::string& text, std::size_t width) {
  return report::encode_utf8(report::shortened(report::printable(text), width));
}

std::string decimal(double value) {
  return fmt::format("{:.4f}", std::abs(value) < 0.00005 ? 0.0 : value);
}

std::string key_of(std::size_t rating) {
  return rating == kMetricCount ? "aggregate" : std::string(kMetricKeys[rating]);
}

std::string totals(const Merged& merged) {
  std::string text =
      fmt::format("{} assets, {:.1f} MiB: {} meshes, {} triangles drawn, {} stored, {} degenerate\n",
                  merged.assets.size(), static_cast<double>(merged.bytes) / kMebi, merged.meshes.size(),
                  merged.drawn_triangles, merged.unique_triangles, merged.degenerate_triangles);
  if (merged.timing)
    text +=
        fmt::format("rendering times: {} ({}){}\n", merged.timing->device.name, merged.timing->device.type,
                    merged.timing_devices > 1 ? fmt::format(", {} devices", merged.timing_devices) : "");
  if (merged.mixed_timings)
    text += "rendering times: of different kinds of devices, which cannot be rated together; R_rt is empty\n";
  return text;
}

std::string distribution_rows(const Merged& merged) {
  std::string text = fmt::format("{:<28}{:>10}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n", "rating", "meshes",
                                 "mean", "least", "5 %", "25 %", "median", "75 %", "95 %", "most");
  for (std::size_t rating = 0; rating <= kMetricCount; ++rating) {
    std::vector<double> values;
    for (std::size_t mesh = 0; mesh < merged.meshes.size(); ++mesh)
      if (const auto value = rating == kMetricCount ? merged.aggregates[mesh] : merged.ratings[mesh][rating])
        values.push_back(*value);
    const Distribution shape = distribution_of(std::move(values));
    if (shape.count == 0) continue;
    text += fmt::format("{:<28}{:>10}{:>9}{:>9}", key_of(rating), shape.count, decimal(shape.mean),
                        decimal(shape.least));
    for (const double quantile : shape.quantiles) text += fmt::format("{:>9}", decimal(quantile));
    text += fmt::format("{:>9}\n", decimal(shape.greatest));
  }
  return text;
}

std::string offender_rows(const Merged& merged, const Offenders& all, std::size_t width) {
  std::string text;
  for (std::size_t rating = 0; rating <= kMetricCount; ++rating) {
    const auto& offenders = all[rating];
    if (offenders.empty()) continue;
    text += fmt::format("\nhighest {}:\n", key_of(rating));
    for (const Offender& one : offenders) {
      const MergedMesh& mesh = merged.meshes[one.mesh];
      const std::string name =
          merged.assets[mesh.asset].asset + ": " + (one.node.empty() ? one.name : one.node);
      const std::string others = one.others > 0 ? fmt::format(" and {} like it", one.others) : "";
      text += fmt::format("{:>9} {:>10} triangles  {}{}\n", decimal(one.value), mesh.triangles,
                          fit(name, width - 32 - std::min<std::size_t>(others.size(), 20)), others);
    }
  }
  return text;
}

std::string duplicate_rows(const Merged& merged, std::size_t count, std::size_t width) {
  if (merged.duplicates.empty()) return {};
  std::uint64_t redundant = 0;
  for (const Duplicate& one : merged.duplicates) redundant += one.redundant_triangles();
  std::string text = fmt::format("\n{} shapes are stored in several assets, {} triangles more than needed:\n",
                                 merged.duplicates.size(), redundant);
  for (std::size_t i = 0; i < std::min(count, merged.duplicates.size()); ++i) {
    const Duplicate& one = merged.duplicates[i];
    const std::string names =
        merged.assets[one.assets[0]].asset + ", " + merged.assets[one.assets[1]].asset +
        (one.assets.size() > 2 ? fmt::format(" and {} more", one.assets.size() - 2) : "");
    text += fmt::format("{:>10} triangles  {}\n", one.triangles, fit(names, width - 22));
  }
  return text;
}

std::string defect_rows(const Merged& merged) {
  std::string text;
  for (std::size_t kind = 0; kind < analysis::kDefectCount; ++kind)
    if (merged.defects[kind].count > 0)
      text += fmt::format("  {:<24}{:>10} in {} meshes\n", analysis::kDefectKeys[kind],
                          merged.defects[kind].count, merged.defects[kind].meshes);
  return text.empty() ? text : "\ndefects:\n" + text;
}

std::string left_out_rows(const Merged& merged, std::size_t width) {
  if (merged.not_analysed.empty()) return {};
  std::string text = fmt::format("\n{} assets could not be analysed:\n", merged.not_analysed.size());
  for (std::size_t i = 0; i < std::min(kMostAssetsShown, merged.not_analysed.size()); ++i)
    text += "  " + fit(merged.not_analysed[i].reason, width - 2) + '\n';
  if (merged.not_analysed.size() > kMostAssetsShown)
    text += fmt::format("  and {} more\n", merged.not_analysed.size() - kMostAssetsShown);
  return text;
}

}  // namespace

std::string summary_table(const Merged& merged, const Offenders& offenders, std::size_t top,
                          const report::TableStyle& style) {
  const report::UnicodeScope unicode;
  const std::size_t width = width_of(style);
  return totals(merged) + '\n' + distribution_rows(merged) + offender_rows(merged, offenders, width) +
         duplicate_rows(merged, top, width) + defect_rows(merged) + left_out_rows(merged, width);
}

}  // namespace scene_analyzer::library
