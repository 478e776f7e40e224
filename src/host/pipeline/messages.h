// messages.h — What a user has to know about an asset's results, in words.
#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.h"

namespace scene_analyzer::pipeline {

// Appends the import's warnings, meshes beyond a limit, and that there is nothing to rate; whether the
// results were just computed or read.
void describe(const analysis::AssetAnalysis& analysis, std::vector<std::string>& messages);

// Appends how many times of `timing` are missing, and why the first of them is.
void describe_missing_times(const std::string& asset, const analysis::RenderTiming& timing,
                            std::vector<std::string>& messages);

}  // namespace scene_analyzer::pipeline
