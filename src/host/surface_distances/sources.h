// sources.h — From where to search next.
#pragma once

#include <cstdint>
#include <vector>

#include "surface_distances/candidates.h"
#include "surface_distances/dual_graph.h"

namespace scene_analyzer::surface_distances {

// The few edges with the most triangles, where these are many: some may hang on nothing else, and are all
// known once their edge was searched from.
std::vector<std::uint32_t> hubs(const DualGraph& graph);

// At most `count` of `open`: that of the largest bound, and those that have it once the first ones have
// proven what can be expected. May be fewer, but not none. Cost: count x open, as below.
std::vector<std::uint32_t> highest_bounds(const std::vector<std::uint32_t>& open,
                                          const Candidates& candidates, std::size_t count);

// At most `count` of `nodes` (their places there), one by one that which is farthest from all before.
// `nearest`, per node: about how far it is from sources before these.
std::vector<std::size_t> farthest_apart(const std::vector<std::uint32_t>& nodes, std::vector<float> nearest,
                                        const Candidates& candidates, std::size_t count);

// At most `count` of `open`, one by one that which is farthest from all sources.
std::vector<std::uint32_t> far_from_all(const std::vector<std::uint32_t>& open, const Candidates& candidates,
                                        std::size_t count);

}  // namespace scene_analyzer::surface_distances
