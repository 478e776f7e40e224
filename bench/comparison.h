// comparison.h — Whether device and twin found the same, before either is timed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/analysis.h"

namespace scene_analyzer::bench {

// What differs first, with mesh and both values; nothing when counts are equal, areas agree to 1e-6 of them
// and ratings within 1e-5. Ratings that one side did not compute are not compared when `ratings` is false.
std::optional<std::string> first_difference(const std::vector<analysis::GeometryAnalysis>& device,
                                            const std::vector<analysis::GeometryAnalysis>& twin,
                                            bool ratings);

}  // namespace scene_analyzer::bench
