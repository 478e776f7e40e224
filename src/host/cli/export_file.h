// export_file.h — The analysed scene as a GLB file with the colours of its ratings.
#pragma once

#include "cli/analyze_options.h"
#include "report/report.h"

namespace scene_analyzer::cli {

// Writes --export, where it was asked for: the assets of the report, imported once more, in the colours that
// PictureRequest::content has. Logs what is wrong and returns whether all went well. Throws Interrupted.
// Memory: all scenes, and the file (report/glb.h).
bool write_export(const AnalyzeRequest& request, const report::SceneReport& report);

}  // namespace scene_analyzer::cli
