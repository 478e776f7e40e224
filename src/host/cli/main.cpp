// main.cpp — The program `scene-analyzer`: picks the command and turns errors into exit codes, once.
#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/version.h"
#include "cli/analyze_command.h"
#include "cli/batch_command.h"
#include "cli/cache_command.h"
#include "cli/check_command.h"
#include "cli/devices_command.h"
#include "cli/exit_code.h"
#include "cli/merge_command.h"
#include "cli/option_parsing.h"
#include "cli/run_command.h"
#include "cli/serve_program.h"
#include "cli/view_command.h"
#include "import/import.h"

namespace scene_analyzer::cli {
namespace {

constexpr const char* kHelp =
    "Scene Analyzer rates the meshes of 3D assets: what is too dense, redundant, uneven or slow.\n"
    "\n"
    "Usage:\n"
    "  scene-analyzer COMMAND [OPTION...] [ARGUMENT...]\n"
    "\n"
    "Commands:\n"
    "  analyze   rate every mesh of one or several assets\n"
    "  check     compare assets with a budget; for CI\n"
    "  batch     analyse a library: folders of assets, on one machine or many\n"
    "  merge     rate such a library as one scene\n"
    "  view      look at the rated scene in a window\n"
    "  serve     analyse, rate and draw for programs elsewhere, over gRPC\n"
    "  devices   list the devices that can compute, or test one against known results\n"
    "  cache     remove old analysis files\n"
    "\n"
    "  scene-analyzer COMMAND --help   options with units and defaults, examples\n"
    "  scene-analyzer --version        the version\n"
    "\n"
    "Example:\n"
    "  scene-analyzer analyze room.glb\n";

using Command = int (*)(std::span<const std::string>);
const std::map<std::string, Command> kCommands = {{"analyze", analyze_command}, {"batch", batch_command},
                                                  {"cache", cache_command},     {"check", check_command},
                                                  {"devices", devices_command}, {"merge", merge_command},
                                                  {"serve", serve_program},     {"view", view_command}};

int dispatch(const std::vector<std::string>& arguments) {
  if (arguments.empty())
    throw UsageError(
        "no command is given: analyze, check, batch, merge, view, serve, devices or cache; see "
        "scene-analyzer "
        "--help");
  const std::string& name = arguments.front();
  if (name == "--help" || name == "-h" || name == "help") {
    fmt::print("{}", kHelp);
    return kSuccess;
  }
  if (name == "--version") {
    fmt::print("scene-analyzer {}\n", version());
    return kSuccess;
  }
  if (const auto command = kCommands.find(name); command != kCommands.end())
    return command->second(std::span(arguments).subspan(1));
  std::vector<std::string> names;
  for (const auto& [known, command] : kCommands) names.push_back(known);
  const std::string meant = nearest(name, names);
  throw UsageError(fmt::format("unknown command '{}'{}; see scene-analyzer --help", name,
                               meant.empty() ? "" : fmt::format(", did you mean {}?", meant)));
}

}  // namespace
}  // namespace scene_analyzer::cli

int main(int argc, char** argv) {
  // First of all: the import worker is this program, and needs nothing of the rest.
  if (argc > 1 && std::string(argv[1]) == scene_analyzer::import::kWorkerArgument)
    return scene_analyzer::import::worker_main(argc, argv);
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  return scene_analyzer::cli::run_command([&] { return scene_analyzer::cli::dispatch(arguments); });
}
