#include "cli/command_line.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "cli/option_parsing.h"

namespace scene_analyzer::cli {
namespace {

std::vector<cxxopts::HelpOptionDetails> known_options(const cxxopts::Options& options) {
  std::vector<cxxopts::HelpOptionDetails> known;
  for (const std::string& group : options.groups())
    for (const auto& option : options.group_help(group).options) known.push_back(option);
  return known;
}

const cxxopts::HelpOptionDetails* find(const std::vector<cxxopts::HelpOptionDetails>& known,
                                       std::string_view name) {
  const auto found = std::ranges::find_if(
      known, [&](const auto& option) { return std::ranges::find(option.l, name) != option.l.end(); });
  return found == known.end() ? nullptr : &*found;
}

[[noreturn]] void refuse_unknown(const std::string& argument, std::string_view name,
                                 const std::vector<cxxopts::HelpOptionDetails>& known) {
  std::vector<std::string> names;
  for (const auto& option : known) names.insert(names.end(), option.l.begin(), option.l.end());
  const std::string meant = nearest(name, names);
  throw UsageError(fmt::format("unknown option '{}'{}; see --help (a file of that name goes after --)",
                               argument, meant.empty() ? "" : fmt::format(", did you mean --{}?", meant)));
}

// cxxopts' own messages name neither the value's range nor what was meant, and it takes a following option as
// a value.
void check_options(const std::vector<std::string>& arguments,
                   const std::vector<cxxopts::HelpOptionDetails>& known) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (!argument.starts_with("--")) continue;
    const std::size_t equals = argument.find('=');
    const std::string name = argument.substr(2, equals == std::string::npos ? equals : equals - 2);
    const auto* option = find(known, name);
    if (!option) refuse_unknown(argument, name, known);
    if (option->is_boolean) {
      if (equals != std::string::npos)
        throw UsageError(fmt::format("--{} takes no value: '{}'", name, argument));
      continue;
    }
    if (equals != std::string::npos) continue;
    if (i + 1 == arguments.size() || arguments[i + 1].starts_with("--"))
      throw UsageError(fmt::format("--{} needs a value: --{} {}", name, name, option->arg_help));
    ++i;  // the value, which may begin with a dash: -1,2,3
  }
}

cxxopts::ParseResult parse(cxxopts::Options& options, const std::vector<std::string>& arguments) {
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

CommandLine::CommandLine(cxxopts::Options& options, std::span<const std::string> arguments) {
  const auto separator = std::ranges::find(arguments, "--");
  const std::vector<std::string> before(arguments.begin(), separator);
  const auto known = known_options(options);
  check_options(before, known);
  result_ = parse(options, before);
  for (const auto& option : known)
    if (!option.l.empty() && !option.is_boolean && result_.count(option.l.front()) > 1)
      throw UsageError(fmt::format("--{} is given twice", option.l.front()));
  positional_ = result_.unmatched();
  if (separator != arguments.end()) positional_.insert(positional_.end(), separator + 1, arguments.end());
}

bool CommandLine::flag(const std::string& option) const {
  return result_.count(option) > 0;
}

std::optional<std::string> CommandLine::value(const std::string& option) const {
  if (result_.count(option) == 0) return std::nullopt;
  return result_[option].as<std::string>();
}

void add_common_options(cxxopts::Options& options) {
  options.add_options("Messages")("q,quiet", "errors only on standard error, no progress")(
      "v,verbose", "also say what is done and how long it takes")("h,help", "print this text");
}

}  // namespace scene_analyzer::cli
