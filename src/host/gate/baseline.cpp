#include "gate/baseline.h"

#include <cmath>

#include "report/terminal_text.h"

namespace scene_analyzer::gate {
namespace {

// A name may hold anything but the end of a text, which tells where it ends.
std::string key_of_names(std::string_view node, std::string_view mesh) {
  return std::string(node) + '\0' + std::string(mesh);
}

double tolerance(Quantity quantity, const Weights& weights, double baseline) {
  if (is_timed(quantity, weights)) return kTimeTolerance * std::abs(baseline);
  return info(quantity).whole ? 0 : kRatingTolerance;
}

}  // namespace

bool is_worse(Quantity quantity, const Weights& weights, Bound bound, double value, double baseline) {
  const double allowed = tolerance(quantity, weights, baseline);
  return bound == Bound::kMost ? value > baseline + allowed : value < baseline - allowed;
}

AssetBaseline baseline_of(const AssetState& asset, const Weights& weights,
                          const std::optional<mesh::Vector3>& eye) {
  AssetBaseline baseline;
  baseline.asset = asset.path;
  baseline.parameters = asset.analysis->parameters;
  baseline.weights = weights;
  baseline.eye = eye;
  baseline.timing = asset.rating.timing;
  if (baseline.timing) baseline.timing->device.id.clear();
  for (const Quantity quantity : {Quantity::kAssetTriangles, Quantity::kFileBytes})
    baseline.values[index_of(quantity)] = asset_value(asset, quantity).number;
  for (std::size_t i = 0; i < asset.rating.meshes.size(); ++i) {
    const analysis::InstanceAnalysis& instance = instance_of(asset, i);
    BaselineMesh& mesh = baseline.meshes.emplace_back(
        BaselineMesh{report::valid_utf8(instance.node), report::valid_utf8(instance.mesh), {}});
    for (std::size_t q = 0; q < kQuantityCount; ++q)
      if (const auto quantity = static_cast<Quantity>(q); info(quantity).scope != Scope::kAsset)
        mesh.values[q] = mesh_value(asset, i, quantity).number;
  }
  return baseline;
}

bool same_conditions(const std::optional<analysis::RenderTiming::Conditions>& a,
                     const std::optional<analysis::RenderTiming::Conditions>& b) {
  if (!a || !b) return false;
  const auto without_id = [](analysis::RenderTiming::Conditions conditions) {
    conditions.device.id.clear();
    return conditions;
  };
  return without_id(*a) == without_id(*b);
}

std::vector<std::optional<std::size_t>> match_meshes(const AssetState& asset, const AssetBaseline& baseline) {
  std::unordered_map<std::string, std::vector<std::size_t>> places;
  for (std::size_t i = 0; i < baseline.meshes.size(); ++i)
    places[key_of_names(baseline.meshes[i].node, baseline.meshes[i].mesh)].push_back(i);
  std::unordered_map<std::string, std::size_t> taken;
  std::vector<std::optional<std::size_t>> matches(asset.rating.meshes.size());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const analysis::InstanceAnalysis& instance = instance_of(asset, i);
    const std::string key =
        key_of_names(report::valid_utf8(instance.node), report::valid_utf8(instance.mesh));
    const auto found = places.find(key);
    const std::size_t occurrence = taken[key]++;
    if (found != places.end() && occurrence < found->second.size()) matches[i] = found->second[occurrence];
  }
  return matches;
}

}  // namespace scene_analyzer::gate
