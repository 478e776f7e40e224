// command_line.h — The arguments of one command: cxxopts with this program's manners.
//
// Beyond cxxopts: everything after `--` is a plain argument, arguments may hold commas, an option given twice
// or left without its value is refused, and an unknown option names the one that was probably meant.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace scene_analyzer::cli {

// What a command understands. Only command_line.cpp turns it into cxxopts' options: its header takes longer
// to compile than most of this room.
class Options {
 public:
  struct Option {
    std::string names;             // "long" or "s,long"
    std::string description;       // in --help
    std::string placeholder = {};  // of the value in --help; empty: a flag
  };
  struct Group {
    std::string name;
    std::vector<Option> options;
  };

  Options(std::string program, std::string purpose);
  void usage(std::string text) { usage_ = std::move(text); }  // what follows the command's name
  void add(std::string group, std::vector<Option> options) {
    groups_.push_back({std::move(group), std::move(options)});
  }

  std::string help(const std::vector<std::string>& groups) const;  // 110 columns
  const std::vector<Group>& groups() const { return groups_; }

 private:
  std::string program_, purpose_, usage_ = "[OPTION...]";
  std::vector<Group> groups_;
};

class CommandLine {
 public:
  // `arguments` are those after the command's name. Throws UsageError.
  CommandLine(const Options& options, std::span<const std::string> arguments);

  bool flag(const std::string& option) const;
  std::optional<std::string> value(const std::string& option) const;  // absent when not given
  const std::vector<std::string>& positional() const { return positional_; }

 private:
  std::map<std::string, std::string> given_;  // by the option's long name; a flag's value is empty
  std::vector<std::string> positional_;
};

// --help and the levels of the log, the same for every command.
void add_common_options(Options& options);

}  // namespace scene_analyzer::cli
