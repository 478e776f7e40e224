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
#include "cli/interrupt.h"
#include "cli/logging.h"
#include "cli/merge_command.h"
#include "cli/option_parsing.h"
#include "cli/run_state.h"
#include "cli/view_command.h"
#include "gpu/error.h"
#include "import/import.h"
#include "window/window.h"

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
                                                  {"view", view_command}};

int dispatch(const std::vector<std::string>& arguments) {
  if (arguments.empty())
    throw UsageError(
        "no command is given: analyze, check, batch, merge, view, devices or cache; see scene-analyzer "
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
  if (const auto command = kCommands.find(name); command != kCommands.end()) try {
      return command->second(std::span(arguments).subspan(1));
    } catch (const import::Stopped&) {
      check_interrupt();  // which is what has stopped it
      throw;
    }
  std::vector<std::string> names;
  for (const auto& [known, command] : kCommands) names.push_back(known);
  const std::string meant = nearest(name, names);
  throw UsageError(fmt::format("unknown command '{}'{}; see scene-analyzer --help", name,
                               meant.empty() ? "" : fmt::format(", did you mean {}?", meant)));
}

int report_error(int code, const std::exception& error, const std::string& remedy = "") {
  log_error(fmt::format("{}{}", error.what(), remedy));
  return code;
}

int run(const std::vector<std::string>& arguments) {
  set_up_logging(LogLevel::kNormal);  // until the command knows better
  try {
    return dispatch(arguments);
  } catch (const UsageError& error) {
    return report_error(kUnusable, error);
  } catch (const InputError& error) {
    return report_error(kInputFailed, error);
  } catch (const gpu::NoDevice& error) {
    return report_error(
        kUnusable, error,
        "; 'scene-analyzer devices' lists what is there, and the package mesa-vulkan-drivers brings a "
        "device that runs on the processor");
  } catch (const gpu::DeviceLost& error) {
    const std::string state = describe_run_state();
    return report_error(kUnusable, error, state.empty() ? "" : " The run has ended " + state);
  } catch (const gpu::OutOfMemory& error) {
    return report_error(
        kUnusable, error,
        "; close other programs that use the device, analyse fewer assets at once or choose another "
        "device with --device");
  } catch (const gpu::Error& error) {
    return report_error(kUnusable, error);
  } catch (const window::NoDisplay& error) {
    return report_error(kUnusable, error,
                        "; without a display, 'scene-analyzer analyze FILE --image FILE.png' draws pictures");
  } catch (const Interrupted& stop) {
    say_stopped();
    return stop.exit_code();
  } catch (const std::exception& error) {
    return report_error(kUnusable, error, " (a defect of scene-analyzer; please report it with the command)");
  }
}

}  // namespace
}  // namespace scene_analyzer::cli

int main(int argc, char** argv) {
  // First of all: the import worker is this program, and needs nothing of the rest.
  if (argc > 1 && std::string(argv[1]) == scene_analyzer::import::kWorkerArgument)
    return scene_analyzer::import::worker_main(argc, argv);
  return scene_analyzer::cli::run({argv + (argc > 0 ? 1 : 0), argv + argc});
}
