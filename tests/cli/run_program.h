// run_program.h — Runs the built `scene-analyzer` as a user does.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <memory>
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

// The same, as long as it runs: to be sent signals. One that is left running is killed.
class RunningProgram {
 public:
  explicit RunningProgram(const std::vector<std::string>& arguments, const ProgramOptions& options = {});
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  pid_t id() const { return child_; }
  bool has_ended();
  void send(int signal) const;  // nothing happens once it has ended
  std::string err() const;      // what it has written so far
  ProgramResult wait();

 private:
  struct Capture;
  std::unique_ptr<Capture> capture_;
  int terminal_ = -1;
  pid_t child_ = -1;
  int exit_code_ = -1;  // -1: not waited for
};

// Lines of `text` that begin with `start`.
std::vector<std::string> lines_with(const std::string& text, const std::string& start);

// Lines of standard error but for the progress that slow machines show.
std::vector<std::string> complaints(const ProgramResult& result);

}  // namespace scene_analyzer
