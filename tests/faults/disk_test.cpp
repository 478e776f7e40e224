// Disks that are full, read-only, or gone while the built program runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "cli/assets.h"
#include "cli/run_program.h"
#include "support/small_disk.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::faults {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::AnyOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class DiskTest : public testing::Test {
 protected:
  DiskTest() {
    fs::create_directory(disk_);
    folder_.write("cube.obj", cube_obj());
  }

  ProgramOptions options(const std::map<std::string, std::string>& environment = {}) const {
    return {.environment = environment, .folder = folder_.path()};
  }
  ProgramResult analyze(std::vector<std::string> arguments,
                        const std::map<std::string, std::string>& environment = {}) const {
    arguments.insert(arguments.begin(), "analyze");
    return run_program(arguments, options(environment));
  }
  void write_asset_to_disk() const { folder_.write("disk/cube.obj", cube_obj()); }
  // Writes until nothing fits any more.
  void fill_disk() const {
    std::ofstream stream(disk_ / "filler", std::ios::binary);
    const std::string page(4096, 'x');
    while (stream.write(page.data(), static_cast<std::streamsize>(page.size())).flush()) {
    }
  }
  std::vector<std::string> files_on_disk() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(disk_))
      if (entry.is_regular_file() && entry.path().filename() != "filler")
        names.push_back(fs::relative(entry.path(), disk_).string());
    return names;
  }
  std::string contents(const std::string& name) const { return TemporaryFolder::read(folder_.path() / name); }

  TemporaryFolder folder_;
  const fs::path disk_ = folder_.path() / "disk";
};

// Each kind of output alone: it is refused with its name and the reason, and all else is there.
TEST_F(DiskTest, AnOutputThatDoesNotFitIsNamedAndTheOthersAreWritten) {
  const SmallDisk disk(disk_, "64k");
  if (!disk.mounted()) GTEST_SKIP() << SmallDisk::kWhyNot;
  fill_disk();
  const std::vector<std::pair<std::vector<std::string>, std::string>> outputs = {
      {{"--json", "disk/out.json"}, "disk/out.json"},
      {{"--csv", "disk/out.csv"}, "disk/out.csv"},
      {{"--image", "disk/out.png", "--size", "240x120"}, "disk/out.png"},
      {{"--image-set", "disk/set", "--size", "240x120"}, "disk/set/aggregate.png"},
      {{"--export", "disk/out.glb"}, "disk/out.glb"},
      {{"--histograms", "disk/histograms"}, "disk/histograms/0-cube.csv"},
      {{"--signals", "disk/signals"}, "disk/signals/0-cube-signal.csv"}};
  for (const auto& [output, file] : outputs) {
    SCOPED_TRACE(file);
    fs::remove(folder_.path() / "good.json");
    std::vector<std::string> arguments = {"cube.obj"};
    arguments.insert(arguments.end(), output.begin(), output.end());
    if (output[0] != "--json") arguments.insert(arguments.end(), {"--json", "good.json"});
    const ProgramResult result = analyze(arguments);
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(complaints(result),
                AllOf(Not(IsEmpty()), Each(AllOf(StartsWith("error: "), HasSubstr("disk/"),
                                                 HasSubstr("No space left on device")))))
        << result.err;
    EXPECT_THAT(complaints(result)[0], HasSubstr(file));
    EXPECT_THAT(files_on_disk(), IsEmpty());
    EXPECT_THAT(result.out, HasSubstr("cube"));
    EXPECT_TRUE(output[0] == "--json" || json::accept(contents("good.json")));
    EXPECT_NE(contents("cube.obj.analysis"), "");
  }
}

TEST_F(DiskTest, AnOutputThatDoesNotFitLeavesTheOldOne) {
  const SmallDisk disk(disk_, "64k");
  if (!disk.mounted()) GTEST_SKIP() << SmallDisk::kWhyNot;
  folder_.write("disk/out.json", "old");
  fill_disk();
  EXPECT_EQ(analyze({"cube.obj", "--json", "disk/out.json"}).exit_code, 3);
  EXPECT_EQ(contents("disk/out.json"), "old");
  EXPECT_THAT(files_on_disk(), ElementsAre("out.json"));
}

TEST_F(DiskTest, StandardOutputThatDoesNotFitIsAnError) {
  const std::string command =
      std::string(SCENE_ANALYZER_BINARY) + " analyze cube.obj --metrics distance > /dev/full 2> complaints";
  const int status = std::system(("cd " + folder_.path().string() + " && " + command).c_str());
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_THAT(contents("complaints"), HasSubstr("standard output cannot be written"));
}

TEST_F(DiskTest, AnalysesThatDoNotFitAreAWarning) {
  const SmallDisk disk(disk_, "64k");
  if (!disk.mounted()) GTEST_SKIP() << SmallDisk::kWhyNot;
  write_asset_to_disk();
  fill_disk();
  for (const auto& arguments : {std::vector<std::string>{"disk/cube.obj", "--json", "out.json"},
                                {"cube.obj", "--cache-dir", "disk", "--json", "out.json"}}) {
    SCOPED_TRACE(arguments[1]);
    fs::remove(folder_.path() / "out.json");
    const ProgramResult result = analyze(arguments);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(complaints(result),
                ElementsAre(AllOf(StartsWith("warning: "), HasSubstr(".analysis"), HasSubstr("disk/"),
                                  HasSubstr("No space left on device"), HasSubstr("are not kept"))))
        << result.err;
    EXPECT_THAT(files_on_disk(), ElementsAre("cube.obj"));
    EXPECT_TRUE(json::accept(contents("out.json")));
  }
}

// What only saves time may be lost.
TEST_F(DiskTest, CachesOfTheDeviceThatDoNotFitAreAWarning) {
  const SmallDisk disk(disk_, "64k");
  if (!disk.mounted()) GTEST_SKIP() << SmallDisk::kWhyNot;
  fill_disk();
  const ProgramResult result = analyze({"cube.obj"}, {{"XDG_CACHE_HOME", disk_.string()}});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(complaints(result),
              Each(AllOf(StartsWith("warning: "), HasSubstr("cache"), HasSubstr("No space left on device"))))
      << result.err;
  EXPECT_NE(contents("cube.obj.analysis"), "");
  EXPECT_EQ(run_program({"devices"}, options({{"XDG_CACHE_HOME", disk_.string()}})).exit_code, 0);
}

TEST_F(DiskTest, AReadOnlyDisk) {
  const SmallDisk disk(disk_, "1m");
  if (!disk.mounted()) GTEST_SKIP() << SmallDisk::kWhyNot;
  write_asset_to_disk();
  if (!disk.make_read_only()) GTEST_SKIP() << "the system does not make the disk read-only";
  const ProgramResult result = analyze({"disk/cube.obj", "--json", "out.json", "--csv", "disk/out.csv",
                                        "--image", "disk/out.png", "--size", "240x120"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(complaints(result), Each(HasSubstr("Read-only file system"))) << result.err;
  EXPECT_THAT(complaints(result),
              ElementsAre(AllOf(StartsWith("warning: "), HasSubstr("disk/cube.obj.analysis")),
                          AllOf(StartsWith("error: "), HasSubstr("disk/out.csv")),
                          AllOf(StartsWith("error: "), HasSubstr("disk/out.png"))));
  EXPECT_TRUE(json::accept(contents("out.json")));
  EXPECT_EQ(analyze({"disk/cube.obj"}).exit_code, 0) << "only the analysis could not be written";
}

// The folder is removed when the first of two assets is done.
class VanishingFolderTest : public DiskTest {
 protected:
  ProgramResult analyze_and_remove(std::vector<std::string> arguments, const fs::path& vanishing) {
    fs::create_directory(folder_.path() / "assets");
    folder_.write("assets/cube.obj", cube_obj());
    folder_.write("assets/large.obj", obj_of(cli::flat_grid(150), "large"));
    arguments.insert(arguments.begin(), {"analyze", "assets/cube.obj", "assets/large.obj"});
    RunningProgram program(arguments, options());
    const auto begin = std::chrono::steady_clock::now();
    while (!fs::exists(folder_.path() / "assets/cube.obj.analysis") && !program.has_ended() &&
           std::chrono::steady_clock::now() - begin < std::chrono::minutes(1))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_FALSE(program.has_ended()) << "nothing was left to be done";
    fs::remove_all(folder_.path() / vanishing);
    return program.wait();
  }
};

TEST_F(VanishingFolderTest, OfOutputsIsAnErrorThatNamesThem) {
  const ProgramResult result = analyze_and_remove({"--json", "disk/out.json", "--csv", "out.csv"}, "disk");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(complaints(result), ElementsAre(AllOf(StartsWith("error: "), HasSubstr("disk/out.json"),
                                                    HasSubstr("No such file or directory"))))
      << result.err;
  EXPECT_EQ(lines_with(contents("out.csv"), "").size(), 3U);
}

// Depending on when it vanishes the second asset is read or not; what was read is in the report.
TEST_F(VanishingFolderTest, OfAssetsLeavesWhatWasRead) {
  const ProgramResult result =
      analyze_and_remove({"--json", "out.json", "--image", "out.png", "--size", "240x120"}, "assets");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(complaints(result), AllOf(Not(IsEmpty()), Each(HasSubstr("assets/")))) << result.err;
  const json document = json::parse(contents("out.json"));
  ASSERT_FALSE(document["meshes"].empty());
  EXPECT_EQ(document["meshes"][0]["triangles"], 12);
  EXPECT_FALSE(fs::exists(folder_.path() / "assets"));
  EXPECT_FALSE(fs::exists(folder_.path() / "out.png"));
}

}  // namespace
}  // namespace scene_analyzer::faults
