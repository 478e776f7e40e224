#include "gate/init_budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/version.h"

namespace scene_analyzer::gate {
namespace {

// The least number of two digits and zeros that is not below `value`.
double two_digits_up(double value) {
  if (value < 100) return std::ceil(value);
  double step = 1;
  while (value / step >= 100) step *= 10;
  return std::ceil(value / step) * step;
}

double rounded_up(Quantity quantity, double value) {
  constexpr double kOtherDevices = 1e-4, kOtherRuns = 1.5;
  if (quantity >= Quantity::kFirstDefect) return value;
  if (quantity == Quantity::kRenderingTime) return std::ceil(value * kOtherRuns * 1000) / 1000;
  if (info(quantity).whole) return std::min(two_digits_up(value), info(quantity).greatest);
  return std::min(std::ceil((value + kOtherDevices) * 100) / 100, 1.0);
}

std::optional<double> largest(std::span<const AssetState> assets, Quantity quantity) {
  std::optional<double> most;
  const auto take = [&](const Value& value) {
    if (value.number) most = std::max(most.value_or(*value.number), *value.number);
  };
  for (const AssetState& asset : assets) {
    if (!asset.failure.empty()) continue;
    if (info(quantity).scope == Scope::kAsset)
      take(asset_value(asset, quantity));
    else
      for (std::size_t i = 0; i < asset.rating.meshes.size(); ++i) take(mesh_value(asset, i, quantity));
  }
  return most;
}

// Shortest text that reads back as the same number, as TOML writes it.
std::string toml_number(Quantity quantity, double value) {
  if (info(quantity).whole) return fmt::format("{:.0f}", value);
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

struct Section {
  std::string name, comment;
  std::vector<Quantity> quantities;
};

std::vector<Section> sections() {
  Section size{"size",
               "What the largest asset and its largest mesh have.",
               {Quantity::kTriangles, Quantity::kAssetTriangles, Quantity::kFileBytes}};
  Section ratings{
      "ratings", "Ratings of single meshes; high is worse. docs/metrics.md says what they mean.", {}};
  for (std::size_t i = 0; i < analysis::kMetricCount; ++i)
    if (const auto metric = static_cast<analysis::Metric>(i); metric != analysis::Metric::kRenderingTime)
      ratings.quantities.push_back(quantity_of(metric));
  ratings.quantities.push_back(Quantity::kAggregate);
  Section times{
      "rendering times",
      "Milliseconds per draw; only comparable on one kind of GPU, and never checked on a CPU device.",
      {Quantity::kRenderingTime}};
  Section defects{"defects", "Defects of a single mesh, exactly as they are: no mesh may get more.", {}};
  for (std::size_t i = 0; i < analysis::kDefectCount; ++i)
    defects.quantities.push_back(quantity_of(static_cast<analysis::Defect>(i)));
  return {std::move(size), std::move(ratings), std::move(times), std::move(defects)};
}

std::string limit_line(Quantity quantity, double most) {
  const double limit = rounded_up(quantity, most);
  const std::string line = fmt::format("max.{} = {}", info(quantity).key, toml_number(quantity, limit));
  const bool never_fails =
      !info(quantity).whole && quantity < Quantity::kRenderingTime && limit >= info(quantity).greatest;
  return (never_fails ? "# " + line + "  # some mesh has the most there is" : line) + '\n';
}

std::string rule_of(const Section& section, std::span<const AssetState> assets) {
  std::string lines;
  for (const Quantity quantity : section.quantities)
    if (const auto most = largest(assets, quantity)) lines += limit_line(quantity, *most);
  const std::string head =
      fmt::format("\n# {}\n[[rule]]\nname = \"{}\"\nseverity = \"error\"\n", section.comment, section.name);
  // A rule needs a limit; comments are none.
  const bool has_limit = lines.starts_with("max.") || lines.find("\nmax.") != std::string::npos;
  return has_limit ? head + lines : "";
}

}  // namespace

std::string init_budget(std::span<const AssetState> assets) {
  std::string text = fmt::format(
      "# Budget of scene-analyzer {}: the state of {} assets, rounded up.\n"
      "# Tighten limits, or give parts of the library rules of their own:\n"
      "#   assets = \"props/*\"   meshes = [\"*_lod1\", \"*_lod2\"]   severity = \"warning\"\n"
      "# Each asset is a scene of its own: densities and distances compare meshes of one asset.\n"
      "version = 1\n",
      version(),
      std::ranges::count_if(assets, [](const AssetState& asset) { return asset.failure.empty(); }));
  for (const Section& section : sections()) text += rule_of(section, assets);
  return text;
}

}  // namespace scene_analyzer::gate
