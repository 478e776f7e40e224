// output_options.h — Names of files that a command writes, looked at before any work is done.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/command_line.h"

namespace scene_analyzer::cli {

// "-" is standard output, which is always good. Throws UsageError for no name, a folder, a folder that does
// not exist, and a name that is one of `inputs`.
void check_output(const std::string& option, const std::filesystem::path& path,
                  const std::vector<std::string>& inputs);

using NamedOutputs = std::vector<std::pair<std::string, std::optional<std::filesystem::path>>>;
// Throws UsageError where two options name the same file, or both standard output.
void check_different(const NamedOutputs& outputs);

}  // namespace scene_analyzer::cli
