// asset_state.h — An asset as the gate sees it: its measured values, or why one is missing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "analysis/analysis.h"
#include "gate/budget.h"
#include "gate/quantity.h"
#include "ratings/ratings.h"

namespace scene_analyzer::gate {

// Each asset is a scene of its own: what else is checked in the same command changes none of its values.
struct AssetState {
  std::string path;                                 // see portable_path()
  std::string failure;                              // why it could not be analysed; nothing else then
  std::optional<analysis::AssetAnalysis> analysis;  // with fingerprints of its files
  ratings::SceneRating rating;                      // of this asset alone
};

// Rates the asset under the budget's weights and eye. `metrics`: those that were measured.
AssetState state_of(std::string path, analysis::AssetAnalysis analysis, analysis::MetricSet metrics,
                    const Weights& weights, const std::optional<mesh::Vector3>& eye);

// How an asset is called on every machine: relative to `working_folder` where it can be, with `/`, without
// `.` and needless `..`. Links are not resolved.
std::string portable_path(const std::filesystem::path& asset, const std::filesystem::path& working_folder);

struct Value {
  std::optional<double> number;  // may be infinite: file size aside, nothing here promises more than a double
  std::string why_not;           // where there is no number, for people
};

// Of the whole asset. `quantity` is of Scope::kAsset.
Value asset_value(const AssetState& asset, Quantity quantity);
// Of one of asset.rating.meshes. `quantity` is of another scope.
Value mesh_value(const AssetState& asset, std::size_t mesh, Quantity quantity);

const analysis::InstanceAnalysis& instance_of(const AssetState& asset, std::size_t mesh);
const analysis::GeometryAnalysis& geometry_of(const AssetState& asset, std::size_t mesh);

}  // namespace scene_analyzer::gate
