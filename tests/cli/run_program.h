// run_program.h — Runs the built `scene-analyzer` as a user does.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace scene_analyzer {

struct ProgramResult {
  int exit_code = -1;  // 128 + signal when it was killed
  std::string out, err;
};

struct ProgramOptions {
  std::map<std::string, std::string> environment;  // on top of this process's; "" removes a variable
  std::filesystem::path folder;                    // working folder; empty: this process's
  bool terminal = false;                           // standard output is a pseudo terminal of 80 columns
};

// Every metric but rendering time, which takes long and never gives the same digits: what `analyze` gets as
// --metrics from run_program() when it has neither that option nor --timing-budget.
inline constexpr const char* kUntimedMetrics =
    "polygons_per_planar_group,planar_group_variation,relative_density,distance,cooccurrence_contrast,"
    "fourier_transform";

// Caches (pipeline cache, the driver's shader cache) lie in the build folder, never in the user's home.
ProgramResult run_program(const std::vector<std::string>& arguments, const ProgramOptions& options = {});

// Lines of `text` that begin with `start`.
std::vector<std::string> lines_with(const std::string& text, const std::string& start);

// Lines of standard error but for the progress that slow machines show.
std::vector<std::string> complaints(const ProgramResult& result);

}  // namespace scene_analyzer
