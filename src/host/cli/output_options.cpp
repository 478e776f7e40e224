#include "cli/output_options.h"

#include <fmt/format.h>

#include <system_error>

#include "base/error.h"

namespace scene_analyzer::cli {

namespace fs = std::filesystem;

// Found out now, not after minutes of work.
void check_output(const std::string& option, const fs::path& path, const std::vector<std::string>& inputs) {
  if (path == "-") return;
  std::error_code ignored;  // an unreadable path is reported when it is written
  if (path.empty()) throw UsageError(fmt::format("--{} needs a file name, or - for standard output", option));
  if (fs::is_directory(path, ignored))
    throw UsageError(fmt::format("--{}: '{}' is a folder; a file name is needed", option, path.string()));
  if (path.has_parent_path() && !fs::is_directory(path.parent_path(), ignored))
    throw UsageError(
        fmt::format("--{}: the folder '{}' does not exist", option, path.parent_path().string()));
  for (const std::string& input : inputs)
    if (fs::equivalent(path, input, ignored))
      throw UsageError(
          fmt::format("--{}: '{}' is one of the assets and would be overwritten", option, path.string()));
}

void check_different(const NamedOutputs& outputs) {
  for (auto a = outputs.begin(); a != outputs.end(); ++a)
    for (auto b = a + 1; b != outputs.end(); ++b)
      if (a->second && a->second == "-" && b->second == "-")
        throw UsageError(
            fmt::format("--{} - and --{} - both ask for standard output; one of them needs a file name",
                        a->first, b->first));
      else if (a->second && b->second && a->second->lexically_normal() == b->second->lexically_normal())
        throw UsageError(
            fmt::format("--{} and --{} name the same file '{}'", a->first, b->first, a->second->string()));
}

}  // namespace scene_analyzer::cli
