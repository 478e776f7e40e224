// batch_options.h — The arguments of `batch`.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cli/logging.h"
#include "library/asset_list.h"
#include "library/shards.h"
#include "pipeline/pipeline.h"

namespace scene_analyzer::cli {

struct BatchRequest {
  bool help = false;                // nothing else is set then
  std::vector<std::string> inputs;  // folders, assets, lists of assets; at least one
  library::Filter filter;
  std::filesystem::path out;
  unsigned jobs = 1;
  library::Shard shard;
  pipeline::Options pipeline;  // analysis files lie in the output folder
  std::string device;          // selector, "" = the preferred one
  LogLevel log = LogLevel::kNormal;
};

// Throws UsageError.
BatchRequest parse_batch(std::span<const std::string> arguments, const library::Environment& environment);

std::string batch_help();

}  // namespace scene_analyzer::cli
