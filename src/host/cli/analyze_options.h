// analyze_options.h — The arguments of `analyze`, checked and turned into what pipeline, ratings and report
// take.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/logging.h"
#include "cli/picture_options.h"
#include "pipeline/pipeline.h"
#include "ratings/ratings.h"

namespace scene_analyzer::cli {

struct AnalyzeRequest {
  bool help = false;                // nothing else is set then
  std::vector<std::string> assets;  // as given, at least one
  pipeline::Options pipeline;
  ratings::Options ratings;
  bool defects = false;                                      // a second table
  std::optional<std::filesystem::path> json, csv;            // "-": standard output, at most one of the two
  std::optional<std::filesystem::path> histograms, signals;  // folders, created when missing
  PictureRequest pictures;
  std::optional<std::filesystem::path> export_file;  // --export, GLB
  std::string device;                                // selector, "" = the preferred one
  LogLevel log = LogLevel::kNormal;

  bool table() const { return json != "-" && csv != "-"; }
};

// Throws UsageError for everything that can be known to be wrong before any work is done, also for output
// files that could not be written at the end (a folder, a missing folder, one of the assets).
AnalyzeRequest parse_analyze(std::span<const std::string> arguments);

std::string analyze_help();

}  // namespace scene_analyzer::cli
