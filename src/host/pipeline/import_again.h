// import_again.h — The geometry of an asset that was analysed, for drawing and exporting: most analyses come
// from files, which do not hold it.
#pragma once

#include "analysis/analysis.h"
#include "import/import.h"
#include "mesh/scene.h"

namespace scene_analyzer::pipeline {

// Its instances run along those of the analysis: an asset without any mesh has an instance of an empty one.
// Throws InputError when the asset cannot be imported any more or is not what was analysed, import::Stopped.
mesh::Scene import_again(const analysis::AssetAnalysis& analysis, const import::Limits& limits,
                         import::Textures textures);
// The same of a scene that was imported already.
void check_is_what_was_analysed(mesh::Scene& scene, const analysis::AssetAnalysis& analysis);

}  // namespace scene_analyzer::pipeline
