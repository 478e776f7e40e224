// import_again.h — The geometry of an asset that was analysed, most often from its analysis file.
#pragma once

#include "analysis/analysis.h"
#include "import/import.h"
#include "mesh/scene.h"

namespace scene_analyzer::cli {

// Throws InputError when the asset cannot be imported any more or is not what was analysed.
mesh::Scene import_again(const analysis::AssetAnalysis& analysis, import::Textures textures);

}  // namespace scene_analyzer::cli
