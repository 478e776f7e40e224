// rated_assets.h — An asset made of numbers, which every metric rates.
#pragma once

#include <array>

#include "analysis/analysis.h"

namespace scene_analyzer::test {

// Three mesh instances with three geometries, all ratings of which differ.
inline analysis::AssetAnalysis rated_asset() {
  analysis::AssetAnalysis asset;
  asset.asset = "room.glb";
  asset.computed.set();
  analysis::RenderTiming timing;
  for (const double value : {0.1, 0.4, 0.9}) {
    analysis::GeometryAnalysis geometry;
    geometry.mesh = static_cast<std::uint32_t>(asset.geometries.size());
    geometry.source_triangles = geometry.triangles = 12;
    geometry.surface_area = 1 + 5 * value;
    geometry.polygons_per_planar_group = value;
    geometry.planar_group_variation = 1 - value;
    geometry.cooccurrence_contrast = value * value;
    geometry.fourier_transform = value / 2;
    const double x = 10 * value;
    asset.instances.push_back({.geometry = geometry.mesh,
                               .node = "node",
                               .mesh = "mesh",
                               .bounds = analysis::Bounds{{x, 0, 0}, {x + 1, 1, 1}}});
    asset.geometries.push_back(geometry);
    timing.times.emplace_back().mean_ns = 100 * value + 20;
  }
  asset.timings.push_back(timing);
  return asset;
}

}  // namespace scene_analyzer::test
