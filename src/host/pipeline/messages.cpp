#include "pipeline/messages.h"

#include <fmt/format.h>

#include <algorithm>

namespace scene_analyzer::pipeline {
namespace {

using analysis::AssetAnalysis;

// Meshes named one by one in a message; a library of thousands would bury everything else.
constexpr std::size_t kNamedMeshes = 5;

const std::string& name_of(const AssetAnalysis& analysis, std::size_t geometry) {
  static const std::string kUnused = "not placed by any node";
  const auto user = std::ranges::find(analysis.instances, geometry, &analysis::InstanceAnalysis::geometry);
  return user == analysis.instances.end() ? kUnused : user->mesh.empty() ? user->node : user->mesh;
}

void describe_limits(const AssetAnalysis& analysis, std::vector<std::string>& messages) {
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < analysis.geometries.size(); ++i) {
    const auto& geometry = analysis.geometries[i];
    if (!is_beyond_a_limit(geometry) || ++beyond > kNamedMeshes) continue;
    const bool wholly = !geometry.not_analysed.empty();
    messages.push_back(fmt::format("{}: mesh {} ({}) {}: {}", analysis.asset, geometry.mesh,
                                   name_of(analysis, i), wholly ? "is not analysed" : "has no Fourier rating",
                                   wholly ? geometry.not_analysed : geometry.no_fourier_transform));
  }
  if (beyond > kNamedMeshes)
    messages.push_back(fmt::format("{}: {} more meshes are not analysed for such reasons", analysis.asset,
                                   beyond - kNamedMeshes));
}

}  // namespace

void describe(const AssetAnalysis& analysis, std::vector<std::string>& messages) {
  for (const std::string& warning : analysis.warnings)
    messages.push_back(fmt::format("{}: {}", analysis.asset, warning));
  describe_limits(analysis, messages);
  if (is_beyond_a_limit(analysis)) return;
  const auto has_triangles = [](const auto& geometry) { return geometry.triangles > 0; };
  if (std::ranges::any_of(analysis.geometries, has_triangles)) return;
  const auto has_source = [](const auto& geometry) { return geometry.source_triangles > 0; };
  messages.push_back(fmt::format("{}: {}; there is nothing to rate", analysis.asset,
                                 std::ranges::any_of(analysis.geometries, has_source)
                                     ? "all its triangles are degenerate"
                                     : "it has no triangles"));
}

void describe_missing_times(const std::string& asset, const analysis::RenderTiming& timing,
                            std::vector<std::string>& messages) {
  const auto missing = [](const auto& time) { return !time.not_measured.empty(); };
  const auto first = std::ranges::find_if(timing.times, missing);
  if (first == timing.times.end()) return;
  const auto count = std::ranges::count_if(timing.times, missing);
  messages.push_back(fmt::format("{}: the rendering time of {} {} is not measured: {}", asset, count,
                                 count == 1 ? "mesh" : "meshes", first->not_measured));
}

}  // namespace scene_analyzer::pipeline
