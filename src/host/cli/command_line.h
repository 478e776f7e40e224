// command_line.h — The arguments of one command: cxxopts with this program's manners.
//
// Beyond cxxopts: everything after `--` is a plain argument, arguments may hold commas, an option given twice
// or left without its value is refused, and an unknown option names the one that was probably meant.
#pragma once

#include <cxxopts.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scene_analyzer::cli {

class CommandLine {
 public:
  // `options` describes long options with std::string or boolean values. `arguments` are those after the
  // command's name. Throws UsageError.
  CommandLine(cxxopts::Options& options, std::span<const std::string> arguments);

  bool flag(const std::string& option) const;
  std::optional<std::string> value(const std::string& option) const;  // absent when not given
  const std::vector<std::string>& positional() const { return positional_; }

 private:
  cxxopts::ParseResult result_;
  std::vector<std::string> positional_;
};

// --help and the levels of the log, the same for every command.
void add_common_options(cxxopts::Options& options);

}  // namespace scene_analyzer::cli
