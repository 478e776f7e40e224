// merge_options.h — The arguments of `merge`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "cli/logging.h"
#include "library/merge.h"

namespace scene_analyzer::cli {

struct MergeRequest {
  bool help = false;  // nothing else is set then
  std::filesystem::path folder;
  library::MergeOptions merge;
  std::optional<std::filesystem::path> json, csv;  // "-": standard output, at most one of the two
  std::size_t top = 10;
  LogLevel log = LogLevel::kNormal;

  bool table() const { return json != "-" && csv != "-"; }
};

// Throws UsageError.
MergeRequest parse_merge(std::span<const std::string> arguments);

std::string merge_help();

}  // namespace scene_analyzer::cli
