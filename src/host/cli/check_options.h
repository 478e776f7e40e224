// check_options.h — The arguments of `check`.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/logging.h"
#include "pipeline/pipeline.h"

namespace scene_analyzer::cli {

struct CheckRequest {
  bool help = false;                // nothing else is set then
  std::vector<std::string> assets;  // each once, at least one
  std::optional<std::filesystem::path> budget, init;
  std::optional<std::filesystem::path> baseline, write_baseline;  // folders
  std::optional<std::filesystem::path> json, junit, sarif;        // "-": standard output, at most one of them
  bool github = false, strict = false, allow_cpu_timing = false;
  bool choose_metrics = false;  // pipeline.metrics is from --metrics
  pipeline::Options pipeline;
  std::string device;  // selector, "" = the preferred one
  LogLevel log = LogLevel::kNormal;

  bool table() const { return json != "-" && junit != "-" && sarif != "-"; }
};

// Throws UsageError, also for output files that could not be written at the end, a baseline that is not
// there, and a budget that --init would overwrite.
CheckRequest parse_check(std::span<const std::string> arguments);

std::string check_help();

}  // namespace scene_analyzer::cli
