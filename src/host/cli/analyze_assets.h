// analyze_assets.h — The assets of one run through the pipeline, one after the other but for start triangles:
// these are searched for while the next asset is imported and measured.
#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "cli/analyze_options.h"
#include "cli/lazy_device.h"

namespace scene_analyzer::cli {

struct FailedAsset {
  std::string asset;   // as given
  std::string reason;  // as it was logged; mostly begins with the asset's name
};

// The assets that could be analysed, in the order given, the others, and whether all went well.
struct Analyses {
  std::vector<analysis::AssetAnalysis> assets;
  std::vector<FailedAsset> failed;  // in the order given
  bool all_good = true;
};

// Logs what is wrong with an asset and shows progress. An asset given twice is analysed once. Memory: the
// scenes of at most two assets. Throws Interrupted, gpu::NoDevice and gpu::DeviceLost.
Analyses analyze_assets(const AnalyzeRequest& request, LazyDevice& device);

}  // namespace scene_analyzer::cli
