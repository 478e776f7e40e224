#include "faults/fault_test.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "cli/assets.h"
#include "faults/fault_rules.h"

namespace scene_analyzer::faults {

namespace fs = std::filesystem;

std::uint64_t fault_runs(std::uint64_t usual) {
  const char* runs = std::getenv("SCENE_ANALYZER_FAULT_RUNS");
  return runs == nullptr || *runs == '\0' ? usual : parse_count(runs);
}

std::vector<std::uint64_t> spread_calls(std::uint64_t count, std::uint64_t runs) {
  std::vector<std::uint64_t> calls;
  const std::uint64_t wanted = std::min(count, runs);
  for (std::uint64_t i = 0; i < wanted; ++i)
    calls.push_back(wanted == 1 ? 1 : 1 + i * (count - 1) / (wanted - 1));
  return calls;
}

FaultTest::FaultTest() : assets_{{"cube.obj", cube_obj()}, {"leg.obj", leg_obj()}} {}

void FaultTest::make_folder() {
  folder_ = std::make_unique<TemporaryFolder>();
  for (const auto& [name, contents] : assets_) folder_->write(name, contents);
}

std::unique_ptr<RunningProgram> FaultTest::start_in_folder(std::map<std::string, std::string> environment) {
  ProgramOptions options;
  options.folder = folder_->path();
  options.environment = std::move(environment);
  options.environment["VK_ADD_LAYER_PATH"] = SCENE_ANALYZER_TEST_LAYERS;
  options.environment["VK_INSTANCE_LAYERS"] = kFaultLayer;
  std::vector<std::string> arguments = {"analyze"};
  for (const auto& [name, contents] : assets_) arguments.push_back(name);
  arguments.insert(arguments.end(), arguments_.begin(), arguments_.end());
  return std::make_unique<RunningProgram>(arguments, options);
}

std::unique_ptr<RunningProgram> FaultTest::start(const std::string& rule) {
  make_folder();
  return start_in_folder({{kRulesVariable, rule}});
}

std::unique_ptr<RunningProgram> FaultTest::start_again() {
  return start_in_folder({});
}

void FaultTest::run_undisturbed(const std::vector<std::string>& arguments,
                                const std::vector<std::string>& outputs) {
  arguments_ = arguments;
  const TemporaryFolder counted;
  const fs::path counts = counted.path() / "counts";
  make_folder();
  const ProgramResult result = start_in_folder({{kCountsVariable, counts.string()}})->wait();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  files_.clear();
  for (const std::string& name : outputs) files_[name] = contents(name);
  for (const auto& [asset, text] : assets_) files_[asset + ".analysis"] = contents(asset + ".analysis");
  for (const auto& [name, bytes] : files_) ASSERT_NE(bytes, "") << name;
  std::istringstream lines(TemporaryFolder::read(counts));
  std::string function;
  for (std::uint64_t count = 0; lines >> function >> count;) calls_[function] = count;
  ASSERT_GT(calls("vkQueueSubmit2"), 0U) << "the layer was not there";
}

ProgramResult FaultTest::run_with(const std::string& rule) {
  return start(rule)->wait();
}

std::uint64_t FaultTest::calls(const std::string& function) const {
  const auto found = calls_.find(function);
  return found == calls_.end() ? 0 : found->second;
}

std::string FaultTest::contents(const std::string& name) const {
  return TemporaryFolder::read(folder_->path() / name);
}

std::vector<std::string> FaultTest::names_in_folder() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder_->path()))
    if (entry.is_regular_file()) names.push_back(fs::relative(entry.path(), folder_->path()).string());
  for (const auto& [asset, text] : assets_) std::erase(names, asset);
  return names;
}

void FaultTest::expect_files_absent_or_whole() const {
  for (const std::string& name : names_in_folder()) {
    const auto known = files_.find(name);
    if (known == files_.end())
      ADD_FAILURE() << name << " was left behind";
    else
      EXPECT_TRUE(contents(name) == known->second) << name << " is not what it should be";
  }
}

void FaultTest::report(const std::string& what, std::size_t failed, std::uint64_t all) {
  std::cout << "failed in turn: " << failed << " of " << all << " " << what << '\n';
}

}  // namespace scene_analyzer::faults
