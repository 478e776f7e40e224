// What is wrong with assets and options, one clear line each; the rest of the command is done all the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/assets.h"
#include "cli/run_program.h"
#include "support/temporary_folder.h"

namespace scene_analyzer {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class BadInputTest : public testing::Test {
 protected:
  ProgramResult analyze(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "analyze");
    ProgramOptions options;
    options.folder = folder_.path();
    return run_program(arguments, options);
  }

  // `name` fails with one error line that names it; the good asset after it is analysed.
  void expect_only_this_fails(const std::string& name, const std::string& reason = "") {
    SCOPED_TRACE(name);
    folder_.write("good.obj", cube_obj());
    const ProgramResult result = analyze({name, "good.obj", "--no-cache"});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(lines_with(result.err, "error: "), ElementsAre(AllOf(HasSubstr(name), HasSubstr(reason))))
        << result.err;
    EXPECT_THAT(result.out, HasSubstr("cube"));
  }

  TemporaryFolder folder_;
};

TEST_F(BadInputTest, MissingFile) {
  expect_only_this_fails("missing.obj", "no such file");
}

TEST_F(BadInputTest, Folder) {
  fs::create_directory(folder_.path() / "folder.obj");
  expect_only_this_fails("folder.obj", "folder");
}

TEST_F(BadInputTest, EmptyFile) {
  folder_.write("empty.glb", "");
  expect_only_this_fails("empty.glb", "empty");
}

TEST_F(BadInputTest, TruncatedFile) {
  std::string glb = "glTF";
  for (const unsigned number : {2U, 400U})  // the version, and a length that the file does not have
    for (unsigned shift = 0; shift < 32; shift += 8) glb += static_cast<char>(number >> shift & 0xff);
  folder_.write("truncated.glb", glb);
  expect_only_this_fails("truncated.glb");
}

TEST_F(BadInputTest, WrongMagic) {
  folder_.write("noise.glb", std::string(200, '\x7e'));
  folder_.write("noise.fbx", "this is no FBX file");
  expect_only_this_fails("noise.glb");
  expect_only_this_fails("noise.fbx");
}

TEST_F(BadInputTest, MissingBuffer) {
  folder_.write("nobin.gltf", gltf_triangle("nobin.bin"));
  expect_only_this_fails("nobin.gltf", "nobin.bin");
}

TEST_F(BadInputTest, UnsupportedFormat) {
  folder_.write("notes.docx", "words");
  expect_only_this_fails("notes.docx", "unsupported");
}

TEST_F(BadInputTest, NamesCannotDriveTheTerminal) {
  const ProgramResult result = analyze({"\x1b[31mred.obj"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, testing::Not(HasSubstr("\x1b")));
}

TEST_F(BadInputTest, AMissingMaterialFileIsAWarning) {
  folder_.write("nomtl.obj", "mtllib nowhere.mtl\n" + cube_obj());
  const ProgramResult result = analyze({"nomtl.obj"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(lines_with(result.err, "warning: "),
              ElementsAre(AllOf(HasSubstr("nomtl.obj"), HasSubstr("nowhere.mtl"))));
}

TEST_F(BadInputTest, WhenEveryAssetFailsTheFilesAreWrittenEmpty) {
  const ProgramResult result = analyze({"a.obj", "b.obj", "--json", "out.json", "--csv", "out.csv"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(lines_with(result.err, "error: ").size(), 2U);
  EXPECT_EQ(result.out, "");
  const auto document = nlohmann::json::parse(TemporaryFolder::read(folder_.path() / "out.json"));
  EXPECT_EQ(document["meshes"], nlohmann::json::array());
  EXPECT_EQ(document["schema_version"], 1);
  EXPECT_EQ(lines_with(TemporaryFolder::read(folder_.path() / "out.csv"), "").size(), 1U) << "a header line";
}

TEST_F(BadInputTest, AnAssetWithoutTrianglesIsAWarningAndAnEmptyRow) {
  folder_.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\no line\nf 1 2 3\n");
  const ProgramResult result = analyze({"flat.obj", "--json", "-"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(lines_with(result.err, "warning: "),
              ElementsAre(AllOf(HasSubstr("flat.obj"), HasSubstr("degenerate"))));
  const auto mesh = nlohmann::json::parse(result.out)["meshes"][0];
  EXPECT_EQ(mesh["triangles"], 0);
  EXPECT_EQ(mesh["degenerate_triangles"], 1);
  EXPECT_TRUE(mesh["aggregate"].is_null());
}

TEST_F(BadInputTest, AnAssetWithoutAnyMeshHasARowToo) {
  folder_.write("points.ply",
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
                "z\nend_header\n0 0 0\n1 0 0\n0 1 0\n");
  const ProgramResult result = analyze({"points.ply", "--json", "-"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(lines_with(result.err, "warning: "),
              ElementsAre(AllOf(HasSubstr("points.ply"), HasSubstr("no triangles"))));
  EXPECT_EQ(nlohmann::json::parse(result.out)["meshes"].size(), 1U);
}

TEST_F(BadInputTest, TooManyTrianglesAreRefusedAlsoWhereAnAnalysisFileIsThere) {
  folder_.write("cube.obj", cube_obj());
  EXPECT_EQ(analyze({"cube.obj", "--max-triangles", "12"}).exit_code, 0);
  ASSERT_TRUE(fs::exists(folder_.path() / "cube.obj.analysis"));
  const ProgramResult result = analyze({"cube.obj", "--max-triangles", "11"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(
      lines_with(result.err, "error: "),
      ElementsAre(HasSubstr("cube.obj: holds 12 triangles, more than the limit of 11 (--max-triangles)")));
}

TEST_F(BadInputTest, TheTimeLimitOfTheImportIsNamed) {
  folder_.write("cube.obj", cube_obj());
  const ProgramResult result = analyze({"cube.obj", "--no-cache", "--import-timeout", "0.001"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(lines_with(result.err, "error: "),
              ElementsAre(HasSubstr("longer than the limit of 0.001 s (--import-timeout)")));
}

TEST_F(BadInputTest, WhatTheImportTookIsSaidOnRequest) {
  folder_.write("cube.obj", cube_obj());
  const ProgramResult result = analyze({"cube.obj", "--no-cache", "--verbose"});
  EXPECT_THAT(result.err,
              testing::ContainsRegex("cube.obj: imported in [0-9.]+ s; its arrays take [0-9.]+ MiB, the "
                                     "import worker's peak was [1-9][0-9.]+ MiB"));
  EXPECT_THAT(result.err, testing::ContainsRegex("peak memory of this process [1-9][0-9.]+ MiB"));
}

TEST_F(BadInputTest, UnwritableOutputsAreExitCode3) {
  folder_.write("good.obj", cube_obj());
  const ProgramResult result = analyze({"good.obj", "--json", "/proc/out.json", "--csv", "out.csv"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(lines_with(result.err, "error: "), ElementsAre(HasSubstr("/proc/out.json")));
  EXPECT_TRUE(fs::exists(folder_.path() / "out.csv"));
  EXPECT_THAT(result.out, HasSubstr("cube"));
}

TEST_F(BadInputTest, WrongOptionsAreExitCode2AndNothingIsWritten) {
  folder_.write("good.obj", cube_obj());
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--alpha", "181"},
                                                {"--alpha", "nan"},
                                                {"--dim", "1"},
                                                {"--steps", "0"},
                                                {"--eye", "1,2"},
                                                {"--weights", "distance=-1"},
                                                {"--metrics", "beauty"},
                                                {"--colour"},
                                                {"--weld-tolerance=-1"}}) {
    std::vector<std::string> arguments = {"good.obj", "--json", "out.json"};
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    const ProgramResult result = analyze(arguments);
    EXPECT_EQ(result.exit_code, 2) << wrong[0];
    EXPECT_EQ(lines_with(result.err, "error: ").size(), 1U) << result.err;
    EXPECT_EQ(result.out, "");
  }
  EXPECT_FALSE(fs::exists(folder_.path() / "out.json"));
  EXPECT_FALSE(fs::exists(folder_.path() / "good.obj.analysis"));
}

}  // namespace
}  // namespace scene_analyzer
