// fault_test.h — The built program on a few assets while something goes wrong, compared with a run in
// which nothing did.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/run_program.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::faults {

// How many faults of a kind are tried in turn, evenly spread over all: SCENE_ANALYZER_FAULT_RUNS, by default
// `usual`.
std::uint64_t fault_runs(std::uint64_t usual);
// Of calls 1 to `count`, `runs` or all.
std::vector<std::uint64_t> spread_calls(std::uint64_t count, std::uint64_t runs);

class FaultTest : public testing::Test {
 protected:
  FaultTest();

  // What `analyze` of all assets with these arguments writes when nothing fails, and how often it calls
  // which Vulkan function. `outputs`: names of the files that the arguments ask for.
  void run_undisturbed(const std::vector<std::string>& arguments, const std::vector<std::string>& outputs);
  // The same run with a rule for the fault layer, in a folder of its own.
  ProgramResult run_with(const std::string& rule);
  // The same, which goes on meanwhile.
  std::unique_ptr<RunningProgram> start(const std::string& rule = "");
  // In the folder of the run before, as it was left.
  std::unique_ptr<RunningProgram> start_again();

  std::uint64_t calls(const std::string& function) const;
  const std::filesystem::path& folder() const { return folder_->path(); }
  std::vector<std::string> names_in_folder() const;     // but for the assets
  std::string contents(const std::string& name) const;  // of the last run; empty: there is no such file
  std::string undisturbed(const std::string& name) const { return files_.at(name); }

  // Every analysis file and every output is absent or what the undisturbed run wrote, and nothing else is
  // there. Only for runs that always write the same: without rendering times.
  void expect_files_absent_or_whole() const;

  // Prints how many of how many calls of what were failed in turn.
  static void report(const std::string& what, std::size_t failed, std::uint64_t all);

  std::vector<std::pair<std::string, std::string>> assets_;  // name and contents: cube.obj and leg.obj
  std::vector<std::string> arguments_;                       // behind the assets

 private:
  std::unique_ptr<RunningProgram> start_in_folder(std::map<std::string, std::string> environment);
  void make_folder();

  std::map<std::string, std::string> files_;  // of the undisturbed run
  std::map<std::string, std::uint64_t> calls_;
  std::unique_ptr<TemporaryFolder> folder_;
};

}  // namespace scene_analyzer::faults
