// plausible.h — Whether an analysis can be one: ranges, indices, vocabulary. Inside this room only.
#pragma once

#include <optional>
#include <string>

#include "analysis/analysis.h"

namespace scene_analyzer::analysis_file {

// What is wrong first ("instance 3: geometry 7 of 5"), or nothing. Asked before writing, so that what was
// written can be read, and after reading, because a right checksum says who garbled the numbers, not that
// they make sense. Matrices are not judged: they are the asset's own and may hold anything.
std::optional<std::string> implausible(const analysis::AssetAnalysis& analysis);

}  // namespace scene_analyzer::analysis_file
