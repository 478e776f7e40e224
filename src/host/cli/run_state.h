// run_state.h — How far a run has come, for the message of one that ends early. For all threads.
#pragma once

#include <cstddef>
#include <string>

namespace scene_analyzer::cli {

// Of the assets given. One that failed is done, too; `kept`: its analysis file is there and true.
enum class RunKind { kReport, kLibrary };  // whether there is a report at its end
void begin_run(std::size_t assets, RunKind kind = RunKind::kReport);
void note_asset_done(bool kept);
// Table, JSON and CSV are written.
void note_report_written();

// Empty before begin_run(), else
// "after 2 of 3 assets: the report is not written; 2 assets are kept in their analysis files, from which the
// same command goes on"
std::string describe_run_state();

}  // namespace scene_analyzer::cli
