// The commands beside `analyze`: help, version, devices, cache.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "support/temporary_folder.h"

namespace scene_analyzer {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

TEST(Commands, HelpTeaches) {
  const ProgramResult help = run_program({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("analyze"), HasSubstr("devices"), HasSubstr("cache")));
  for (const char* command : {"analyze", "check", "devices", "cache"}) {
    const ProgramResult result = run_program({command, "--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.out, AllOf(HasSubstr("Usage:"), HasSubstr("Examples:"), HasSubstr("Exit codes:")))
        << command;
    EXPECT_EQ(result.err, "");
  }
  EXPECT_THAT(run_program({"devices", "--help"}).out, HasSubstr("SCENE_ANALYZER_VALIDATION"));
}

TEST(Commands, VersionIsThatOfTheBuild) {
  const ProgramResult result = run_program({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "scene-analyzer " SCENE_ANALYZER_VERSION "\n");
}

TEST(Commands, UnknownOnesSuggestTheNearest) {
  const ProgramResult result = run_program({"analyse"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("did you mean analyze?"));
  EXPECT_EQ(run_program({}).exit_code, 2);
}

TEST(Devices, ListsWhatIsThere) {
  const ProgramResult table = run_program({"devices"});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out, AllOf(HasSubstr("Name"), HasSubstr("*")));
  const ProgramResult result = run_program({"devices", "--json"});
  EXPECT_EQ(result.exit_code, 0);
  const auto devices = nlohmann::json::parse(result.out)["devices"];
  ASSERT_GE(devices.size(), 1U);
  int defaults = 0;
  for (const auto& device : devices) {
    EXPECT_THAT(table.out, HasSubstr(device["name"].get<std::string>()));
    EXPECT_EQ(device["usable"].get<bool>(), device["refusals"].empty());
    defaults += device["default"].get<bool>() ? 1 : 0;
  }
  EXPECT_EQ(defaults, 1);
}

TEST(Devices, WithoutADriverThereIsARemedy) {
  ProgramOptions options;
  options.environment = {{"VK_DRIVER_FILES", "/nonexistent"}, {"VK_ICD_FILENAMES", "/nonexistent"}};
  const ProgramResult result = run_program({"devices"}, options);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("mesa-vulkan-drivers"));
}

TEST(Devices, SelftestComputesKnownResults) {
  const ProgramResult result = run_program({"devices", "--selftest"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_GE(lines_with(result.out, "ok ").size(), 30U);
  EXPECT_TRUE(lines_with(result.out, "FAILED").empty()) << result.out;
  EXPECT_EQ(run_program({"devices", "--selftest", "--device", "no such device"}).exit_code, 2);
}

TEST(Devices, OptionsThatDoNotGoTogether) {
  EXPECT_EQ(run_program({"devices", "--device", "0"}).exit_code, 2);
  EXPECT_EQ(run_program({"devices", "--selftest", "--json"}).exit_code, 2);
  EXPECT_EQ(run_program({"devices", "stray"}).exit_code, 2);
}

TEST(Cache, PruneRemovesWhatIsOld) {
  const TemporaryFolder folder;
  const auto old = folder.write("old.obj.analysis", "x");
  fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(24 * 100));
  folder.write("new.obj.analysis", "x");
  folder.write("notes.txt", "x");
  const ProgramResult result = run_program({"cache", "--prune", "--cache-dir", folder.path().string()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("removed 1 files (1 bytes), kept 1 files (1 bytes)"));
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(folder.path() / "notes.txt"));
  EXPECT_EQ(
      run_program({"cache", "--prune", "--cache-dir", folder.path().string(), "--max-size", "0"}).exit_code,
      0);
  EXPECT_FALSE(fs::exists(folder.path() / "new.obj.analysis"));
}

TEST(Cache, WrongUse) {
  const TemporaryFolder folder;
  const std::string place = folder.path().string();
  EXPECT_EQ(run_program({"cache"}).exit_code, 2);
  EXPECT_EQ(run_program({"cache", "--prune"}).exit_code, 2);
  EXPECT_EQ(run_program({"cache", "--prune", "--cache-dir", place + "/nowhere"}).exit_code, 3);
  EXPECT_EQ(run_program({"cache", "--prune", "--cache-dir", place, "--max-age", "-1"}).exit_code, 2);
  EXPECT_EQ(run_program({"cache", "--prune", "--cache-dir", place, "--max-size", "big"}).exit_code, 2);
  EXPECT_EQ(run_program({"cache", "--prune", "--cache-dir", place, "stray"}).exit_code, 2);
}

}  // namespace
}  // namespace scene_analyzer
