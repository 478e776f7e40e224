#include "cli/serve_program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "files/helper_program.h"

namespace scene_analyzer::cli {

int serve_program(std::span<const std::string> arguments) {
  const std::filesystem::path program = files::helper_program(kServeProgram);
  if (program.empty())
    throw UsageError(
        fmt::format("the program {} is missing beside this one; install Scene Analyzer anew", kServeProgram));
  std::vector<std::string> words = {kServeProgram};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(program.c_str(), pointers.data());
  throw UsageError(
      fmt::format("'{}' cannot be run: {}", program.string(), std::generic_category().message(errno)));
}

}  // namespace scene_analyzer::cli
