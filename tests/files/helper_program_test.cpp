// Where programs are found that belong to this one: asked by a program that is put where it would be
// installed.
#include <gtest/gtest.h>
#include <stdio.h>
#include <sys/stat.h>

#include <array>

#include "support/temporary_folder.h"

namespace scene_analyzer::files {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "scene-analyzer-helper";

class HelperProgramTest : public testing::Test {
 protected:
  HelperProgramTest() {
    fs::create_directories(bin_);
    fs::create_directories(libexec_);
    fs::copy_file(FIND_HELPER_PROGRAM, bin_ / "program");
    fs::current_path(root_);
  }
  ~HelperProgramTest() override { fs::current_path(before_); }

  static void put(const fs::path& path, mode_t mode = 0755) {
    std::ofstream(path) << "#!/bin/sh\n";
    ASSERT_EQ(::chmod(path.c_str(), mode), 0);
  }

  // What `program` says, started as a user would start it.
  static std::string said_by(const std::string& program) {
    const std::string command = "'" + program + "' " + kName;
    FILE* const answer = ::popen(command.c_str(), "r");
    if (answer == nullptr) throw std::runtime_error("cannot run " + command);
    std::string said;
    std::array<char, 4096> part{};
    while (const std::size_t count = ::fread(part.data(), 1, part.size(), answer))
      said.append(part.data(), count);
    EXPECT_EQ(::pclose(answer), 0) << command;
    return said;
  }
  std::string found() const { return said_by(bin_ / "program"); }

  const fs::path before_ = fs::current_path();
  const TemporaryFolder folder_;
  const fs::path root_ = fs::canonical(folder_.path());
  const fs::path bin_ = root_ / "usr with space/bin";
  const fs::path libexec_ = root_ / "usr with space/libexec/scene-analyzer";
};

TEST_F(HelperProgramTest, IsFoundBesideTheProgram) {
  put(bin_ / kName);
  EXPECT_EQ(found(), bin_ / kName);
}

TEST_F(HelperProgramTest, IsFoundWhereItIsInstalled) {
  put(libexec_ / kName);
  EXPECT_EQ(found(), libexec_ / kName);
}

TEST_F(HelperProgramTest, TheOneBesideComesFirst) {
  put(bin_ / kName);
  put(libexec_ / kName);
  EXPECT_EQ(found(), bin_ / kName);
}

TEST_F(HelperProgramTest, NoneIsFoundElsewhere) {
  for (const fs::path& folder : {root_, bin_.parent_path(), libexec_.parent_path()}) {
    const fs::path place = folder / kName;
    put(place);
    EXPECT_EQ(found(), "") << place;
    fs::remove(place);
  }
  put(libexec_ / (std::string(kName) + "-2"));
  EXPECT_EQ(found(), "") << "of another name";
}

TEST_F(HelperProgramTest, WhatCannotBeStartedIsNone) {
  put(bin_ / kName, 0644);
  EXPECT_EQ(found(), "");
  put(libexec_ / kName);
  EXPECT_EQ(found(), libexec_ / kName) << "the next is tried";
  fs::remove(bin_ / kName);
  fs::create_directory(bin_ / kName);
  EXPECT_EQ(found(), libexec_ / kName) << "a folder";
  fs::remove(bin_ / kName);
  fs::create_symlink(root_ / "gone", bin_ / kName);
  EXPECT_EQ(found(), libexec_ / kName) << "a link to nothing";
  put(root_ / "gone");
  EXPECT_EQ(found(), bin_ / kName) << "a link to a program";
}

TEST_F(HelperProgramTest, LinksToTheProgramLeadToItsOwnFolder) {
  put(libexec_ / kName);
  fs::create_directory(root_ / "links");
  put(root_ / "links" / kName);
  fs::create_symlink(bin_ / "program", root_ / "links/program");
  EXPECT_EQ(said_by(root_ / "links/program"), libexec_ / kName);
}

TEST_F(HelperProgramTest, TheCurrentFolderDoesNotMatter) {
  put(bin_ / kName);
  fs::current_path(bin_);
  EXPECT_EQ(said_by("./program"), bin_ / kName);
}

}  // namespace
}  // namespace scene_analyzer::files
