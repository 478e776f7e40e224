// picture_files.h — Draws the analysed scene and writes what was asked for.
#pragma once

#include "cli/analyze_options.h"
#include "cli/lazy_device.h"
#include "report/report.h"

namespace scene_analyzer::cli {

// Imports the assets of the report again, with their textures, draws them together and writes each picture
// as soon as it is drawn. Logs what is wrong and returns whether all went well. Throws Interrupted,
// gpu::NoDevice and gpu::DeviceLost. Memory: one scene on the host, all on the device (scene_model.h).
bool write_pictures(const AnalyzeRequest& request, const report::SceneReport& report, LazyDevice& device);

}  // namespace scene_analyzer::cli
