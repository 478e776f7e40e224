// joined_scene.h — Several assets' scenes as one, so that their meshes share batches on the device, and the
// way back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analysis/analysis.h"
#include "mesh/scene.h"

namespace scene_analyzer::pipeline {

struct JoinedScene {
  mesh::Scene scene;                        // meshes and instances only, the parts' one after the other
  std::vector<std::uint32_t> first_meshes;  // of each part, and the number of all meshes
};

// No array is copied: the parts must outlive what is joined. Cost: linear in meshes and instances.
JoinedScene join(std::span<const mesh::Scene* const> parts);

// Where a part's geometries begin among those measured of the joined scene, for each part and the end.
std::vector<std::uint32_t> first_geometries(const JoinedScene& joined,
                                            const analysis::AssetAnalysis& measured);

// Moves geometries and instances of `measured` to the parts they belong to, in their order, which are what
// measuring each part alone would have made. `parts` as many as were joined.
void split(const JoinedScene& joined, analysis::AssetAnalysis&& measured,
           std::span<analysis::AssetAnalysis* const> parts);

}  // namespace scene_analyzer::pipeline
