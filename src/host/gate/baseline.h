// baseline.h — What an asset's values were when the team last accepted them.
//
// With a baseline a value beyond its limit is a finding only if it got worse since. "Worse" is farther in the
// direction of the limit, by more than
//   counts and bytes    nothing
//   ratings             1e-5, which is what devices may differ by
//   rendering times     5 % of the baseline's, which is what two runs may differ by
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "analysis/analysis.h"
#include "gate/asset_state.h"

namespace scene_analyzer::gate {

inline constexpr double kRatingTolerance = 1e-5, kTimeTolerance = 0.05;

// Whether `value` is worse than `baseline`, where less is better (kMost) or more is.
bool is_worse(Quantity quantity, const Weights& weights, Bound bound, double value, double baseline);

using Values = std::array<std::optional<double>, kQuantityCount>;

// Meshes are told apart by the names of node and mesh and, of several of the same names, by their order.
struct BaselineMesh {
  std::string node, mesh;  // UTF-8
  Values values;
};

struct AssetBaseline {
  std::string asset;  // portable_path()
  std::string tool_version;
  analysis::Parameters parameters;
  Weights weights{};
  std::optional<mesh::Vector3> eye;
  std::optional<analysis::RenderTiming::Conditions> timing;  // without the device's id
  Values values;                                             // of the asset
  std::vector<BaselineMesh> meshes;                          // in the asset's order
};

// All that is known of the asset's values.
AssetBaseline baseline_of(const AssetState& asset, const Weights& weights,
                          const std::optional<mesh::Vector3>& eye);

// Whether times of both can be compared: the same kind of device, driver, size and steps.
bool same_conditions(const std::optional<analysis::RenderTiming::Conditions>& a,
                     const std::optional<analysis::RenderTiming::Conditions>& b);

// By asset. An asset that is not there is new.
using Baselines = std::map<std::string, AssetBaseline>;

// Which mesh of the baseline each mesh of the asset is; nothing for new ones.
std::vector<std::optional<std::size_t>> match_meshes(const AssetState& asset, const AssetBaseline& baseline);

}  // namespace scene_analyzer::gate
