#include "cli/view_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <tuple>

#include "base/error.h"
#include "cli/exit_code.h"
#include "cli/lazy_device.h"
#include "cli/logging.h"
#include "cli/measuring_options.h"
#include "cli/option_parsing.h"
#include "viewer/review_keys.h"
#include "viewer/viewer.h"

namespace scene_analyzer::cli {
namespace {

constexpr double kUsualBudget = 5;  // seconds for rendering times: somebody is waiting

constexpr const char* kPurpose =
    "Opens a window with the assets, which together form one scene, every mesh in the colour of its "
    "ratings.\n"
    "Mouse: left button turns, right one shifts, wheel zooms, a click selects a mesh.\n";

constexpr const char* kExamples =
    "Examples:\n"
    "  scene-analyzer view room.glb\n"
    "  scene-analyzer view room.glb lamp.obj --metrics polygons_per_planar_group,relative_density\n"
    "Without a display, 'scene-analyzer analyze room.glb --image room.png' draws a picture.\n";

Options make_options() {
  Options options("scene-analyzer view", kPurpose);
  options.usage("[OPTION...] ASSET...");
  options.add("Window", {
                            {"window-size", "size of the window, default 1280x720", "WxH"},
                        });
  add_measuring_options(options);
  add_running_options(options);
  add_common_options(options);
  return options;
}

void print_text(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

std::string help() {
  return fmt::format("{}\n{}\n{}\n{}\n{}",
                     make_options().help({"Window", "Measuring", "Running", "Messages"}),
                     viewer::key_help(viewer::ReviewState{}), metric_help(), kExamples, kExitCodeHelp);
}

}  // namespace

int view_command(std::span<const std::string> arguments) {
  Options options = make_options();
  const CommandLine line(options, arguments);
  if (line.flag("help")) {
    print_text(help());
    return kSuccess;
  }
  set_up_logging(log_level(line.flag("quiet"), line.flag("verbose")));
  viewer::ViewerOptions view;
  view.assets.assign(line.positional().begin(), line.positional().end());
  check_assets(line.positional(), "view");
  view.pipeline.timing_budget = kUsualBudget;
  read_measuring(line, view.pipeline);
  view.device = device_options(read_running(line, view.pipeline));
  if (const auto size = line.value("window-size"))
    std::tie(view.width, view.height) = parse_pixels("window-size", *size);
  view.warn = [](const std::string& message) { log_warning(message); };
  view.print = print_text;
  view.tell = [](const std::string& message) { log_detail(message); };
  return viewer::run_viewer(view) ? kSuccess : kInputFailed;
}

}  // namespace scene_analyzer::cli
