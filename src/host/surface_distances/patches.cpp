#include "surface_distances/patches.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace scene_analyzer::surface_distances {
namespace {

using Near = std::vector<std::pair<float, std::uint32_t>>;  // distance from the middle, node

// Sorts the front of `near`: what makes a patch. Returns how many that are.
std::size_t keep_nearest(Near& near, const PatchSize& size) {
  const std::size_t most = std::min(size.most, near.size());
  std::ranges::nth_element(near, near.begin() + static_cast<std::ptrdiff_t>(most) - 1);
  std::ranges::sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(most));
  std::size_t taken = std::min(size.least, most);
  while (taken < most && near[taken].first <= size.reach) ++taken;
  return taken;
}

// Patches sweep over the open ones from the far side of a landmark: the next one just reaches the farthest,
// which leaves few gaps.
std::uint32_t next_middle(const std::vector<std::uint32_t>& open, const Candidates& candidates,
                          double reach) {
  const auto distance = [&](std::uint32_t v) { return candidates.landmark_distance(v); };
  const std::uint32_t farthest = *std::ranges::max_element(open, {}, distance);
  std::uint32_t middle = farthest;
  for (const std::uint32_t v : open)
    if (distance(v) < distance(middle) && candidates.about_distance(v, farthest) <= reach) middle = v;
  return middle;
}

}  // namespace

std::vector<Patch> take_patches(std::vector<std::uint32_t>& open, const Candidates& candidates,
                                const PatchSize& size, std::size_t count) {
  std::vector<Patch> patches;
  while (patches.size() < count && !open.empty()) {
    const std::uint32_t centre = next_middle(open, candidates, size.reach);
    Near near;
    near.reserve(open.size());
    for (const std::uint32_t v : open)
      near.emplace_back(v == centre ? -1 : candidates.about_distance(v, centre), v);
    const std::size_t taken = keep_nearest(near, size);
    Patch& patch = patches.emplace_back();
    open.clear();
    for (std::size_t i = 0; i < near.size(); ++i) (i < taken ? patch : open).push_back(near[i].second);
  }
  return patches;
}

Patch patch_around(std::uint32_t centre, const Candidates& candidates, double reach) {
  Patch patch{centre};
  for (const std::uint32_t v : candidates.open())
    if (v != centre && candidates.about_distance(v, centre) <= reach) patch.push_back(v);
  return patch;
}

std::vector<std::uint32_t> highest_apart(const Candidates& candidates, std::size_t count, double apart) {
  std::vector<std::uint32_t> searched;
  for (std::uint32_t v = 0; v < candidates.count(); ++v)
    if (candidates.is_searched(v)) searched.push_back(v);
  std::ranges::stable_sort(searched, std::greater<>{}, [&](std::uint32_t v) { return candidates.upper(v); });
  std::vector<std::uint32_t> taken;
  for (const std::uint32_t v : searched)
    if (taken.size() < count && std::ranges::all_of(taken, [&](std::uint32_t other) {
          return candidates.about_distance(v, other) > apart;
        }))
      taken.push_back(v);
  return taken;
}

}  // namespace scene_analyzer::surface_distances
