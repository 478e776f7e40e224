// patches.h — Groups of candidates near each other.
#pragma once

#include <cstdint>
#include <vector>

#include "surface_distances/candidates.h"

namespace scene_analyzer::surface_distances {

using Patch = std::vector<std::uint32_t>;  // nodes near each other, the first about in the middle

struct PatchSize {
  std::size_t least = 1;  // taken however far they are
  std::size_t most = 1;
  double reach = 0;  // from the middle, as Candidates::about_distance
};

// Takes at most `count` patches out of `open`. Cost: count x open.
std::vector<Patch> take_patches(std::vector<std::uint32_t>& open, const Candidates& candidates,
                                const PatchSize& size, std::size_t count);

// `centre` and the open ones up to `reach` around it.
Patch patch_around(std::uint32_t centre, const Candidates& candidates, double reach);

// At most `count` searched nodes of the largest totals, farther than `apart` from each other.
std::vector<std::uint32_t> highest_apart(const Candidates& candidates, std::size_t count, double apart);

}  // namespace scene_analyzer::surface_distances
