#include "cli/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cxxopts.hpp>
#include <string_view>

#include "base/error.h"
#include "cli/option_parsing.h"

namespace scene_analyzer::cli {
namespace {

constexpr std::size_t kHelpWidth = 110;

std::string long_name(const Options::Option& option) {
  return option.names.substr(option.names.find(',') + 1);  // the whole where there is no comma
}

const Options::Option* find(const std::vector<Options::Option>& known, std::string_view name) {
  const auto found =
      std::ranges::find_if(known, [&](const auto& option) { return long_name(option) == name; });
  return found == known.end() ? nullptr : &*found;
}

[[noreturn]] void refuse_unknown(const std::string& argument, std::string_view name,
                                 const std::vector<Options::Option>& known) {
  std::vector<std::string> names;
  for (const auto& option : known) names.push_back(long_name(option));
  const std::string meant = nearest(name, names);
  throw UsageError(fmt::format("unknown option '{}'{}; see --help (a file of that name goes after --)",
                               argument, meant.empty() ? "" : fmt::format(", did you mean --{}?", meant)));
}

// cxxopts' own messages name neither the value's range nor what was meant, and it takes a following option as
// a value.
void check_options(const std::vector<std::string>& arguments, const std::vector<Options::Option>& known) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (!argument.starts_with("--")) continue;
    const std::size_t equals = argument.find('=');
    const std::string name = argument.substr(2, equals == std::string::npos ? equals : equals - 2);
    const auto* option = find(known, name);
    if (!option) refuse_unknown(argument, name, known);
    if (option->placeholder.empty()) {
      if (equals != std::string::npos)
        throw UsageError(fmt::format("--{} takes no value: '{}'", name, argument));
      continue;
    }
    if (equals != std::string::npos) continue;
    if (i + 1 == arguments.size() || arguments[i + 1].starts_with("--"))
      throw UsageError(fmt::format("--{} needs a value: --{} {}", name, name, option->placeholder));
    ++i;  // the value, which may begin with a dash: -1,2,3
  }
}

cxxopts::Options in_cxxopts(const std::string& program, const std::string& purpose,
                            const std::vector<Options::Group>& groups) {
  cxxopts::Options result(program, purpose);
  for (const auto& group : groups) {
    auto add = result.add_options(group.name);
    for (const auto& option : group.options)
      if (option.placeholder.empty())
        add(option.names, option.description);
      else
        add(option.names, option.description, cxxopts::value<std::string>(), option.placeholder);
  }
  return result;
}

std::vector<Options::Option> all_of(const Options& options) {
  std::vector<Options::Option> all;
  for (const auto& group : options.groups())
    all.insert(all.end(), group.options.begin(), group.options.end());
  return all;
}

cxxopts::ParseResult parse(cxxopts::Options options, const std::vector<std::string>& arguments) {
  std::vector<const char*> argv = {"scene-analyzer"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  try {
    return options.parse(static_cast<int>(argv.size()), argv.data());
  } catch (const cxxopts::exceptions::exception& error) {
    throw UsageError(
        fmt::format("{}; see --help (a file whose name begins with a dash goes after --)", error.what()));
  }
}

}  // namespace

Options::Options(std::string program, std::string purpose)
    : program_(std::move(program)), purpose_(std::move(purpose)) {}

std::string Options::help(const std::vector<std::string>& groups) const {
  return in_cxxopts(program_, purpose_, groups_).custom_help(usage_).set_width(kHelpWidth).help(groups);
}

CommandLine::CommandLine(const Options& options, std::span<const std::string> arguments) {
  const auto separator = std::ranges::find(arguments, "--");
  const std::vector<std::string> before(arguments.begin(), separator);
  const std::vector<Options::Option> known = all_of(options);
  check_options(before, known);
  const cxxopts::ParseResult result = parse(in_cxxopts("", "", options.groups()), before);
  for (const auto& option : known) {
    const std::string name = long_name(option);
    const std::size_t count = result.count(name);
    if (count == 0) continue;
    const bool flag = option.placeholder.empty();
    if (!flag && count > 1) throw UsageError(fmt::format("--{} is given twice", name));
    given_[name] = flag ? "" : result[name].as<std::string>();
  }
  positional_ = result.unmatched();
  if (separator != arguments.end()) positional_.insert(positional_.end(), separator + 1, arguments.end());
}

bool CommandLine::flag(const std::string& option) const {
  return given_.contains(option);
}

std::optional<std::string> CommandLine::value(const std::string& option) const {
  const auto found = given_.find(option);
  return found == given_.end() ? std::nullopt : std::optional(found->second);
}

void add_common_options(Options& options) {
  options.add("Messages", {
                              {"q,quiet", "errors only on standard error, no progress"},
                              {"v,verbose", "also say what is done and how long it takes"},
                              {"h,help", "print this text"},
                          });
}

}  // namespace scene_analyzer::cli
