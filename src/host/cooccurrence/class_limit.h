// class_limit.h — The DIM limit: merges neighbouring area classes greedily until few enough are left.
//
// Each step joins the two neighbouring groups whose union has the least sum |value - mean of the union|,
// compared after rounding to 20 significant bits, ties to the lower pair. The thesis' loop recomputes every
// pair in every step; this one keeps pairs in a queue ordered by cost and gets a union's cost from prefix
// sums. The steps depend on each other, so this runs on the host.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scene_analyzer::cooccurrence {

// `values`: class values of one mesh, strictly ascending and positive; `limit` >= 2. Returns for each class
// the value of its group: the mean of the class values in it. Unchanged when there are at most `limit`
// classes. Cost: n log^2 n time, about 80 bytes per class.
std::vector<double> limit_classes(std::span<const double> values, std::uint64_t limit);

}  // namespace scene_analyzer::cooccurrence
