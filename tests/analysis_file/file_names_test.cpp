// Analyses of assets whose files lie under numbers: they are those of the same files under their true names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "analysis_file/analysis_file.h"
#include "analysis_file/sample.h"
#include "base/error.h"
#include "support/numbered_files.h"

namespace scene_analyzer::analysis_file {
namespace {

using testing::HasSubstr;

const NamedContents kFiles = {{"room.gltf", "asset"}, {"sub/x.bin", "buffer"}, {"a b.png", "picture"}};
const std::vector<mesh::ReferencedFile> kReferences = {
    {"room.gltf", true}, {"sub/x.bin", true}, {"a b.png", true}, {"lost.mtl", false}};

analysis::AssetAnalysis analysis_of(const mesh::AssetSource& asset,
                                    const std::vector<mesh::ReferencedFile>& references = kReferences) {
  analysis::AssetAnalysis analysis = full_analysis();
  analysis.files = fingerprint(asset, references);
  return analysis;
}

class NamedFilesTest : public testing::Test {
 protected:
  // The analysis file that both of them share.
  void keep(const analysis::AssetAnalysis& analysis) const { store(file_, analysis); }
  // Why it is of no use to `asset`; "" when it is.
  std::string reason(const mesh::AssetSource& asset) const {
    const auto loaded = load_valid(file_, asset, full_analysis().parameters);
    const auto* unusable = std::get_if<Unusable>(&loaded);
    return unusable != nullptr ? unusable->reason : "";
  }

  const TemporaryFolder folder_, named_, numbered_;
  const fs::path file_ = folder_.path() / "room.analysis";
  const mesh::AssetSource by_name_ = write_named(named_, kFiles);
  const mesh::AssetSource by_number_ = write_numbered(numbered_, kFiles);
};

TEST_F(NamedFilesTest, HaveTheSameFingerprintsAndKey) {
  const analysis::AssetAnalysis named = analysis_of(by_name_), numbered = analysis_of(by_number_);
  EXPECT_EQ(numbered.files, named.files);
  EXPECT_EQ(content_key(numbered), content_key(named));
  ASSERT_EQ(numbered.files.size(), 4u);
  EXPECT_EQ(numbered.files[0].path, "room.gltf");
  for (const std::size_t i : {0u, 1u, 2u}) {
    EXPECT_TRUE(numbered.files[i].found) << i;
    EXPECT_EQ(numbered.files[i].size, kFiles[i].second.size()) << i;
  }
  EXPECT_EQ(numbered.files[3], (analysis::FileFingerprint{"lost.mtl", false, 0, {}}));
}

TEST_F(NamedFilesTest, TheirNumbersDoNotCount) {
  const TemporaryFolder folder;
  const mesh::AssetSource other =
      write_numbered(folder, {kFiles[0], {"unused", "nothing"}, kFiles[2], kFiles[1]});
  EXPECT_EQ(content_key(analysis_of(other)), content_key(analysis_of(by_number_)));
}

TEST_F(NamedFilesTest, EveryByteCounts) {
  const std::string key = content_key(analysis_of(by_number_));
  for (std::size_t i = 0; i < kFiles.size(); ++i) {
    NamedContents changed = kFiles;
    changed[i].second[0] ^= 1;
    const TemporaryFolder folder;
    EXPECT_NE(content_key(analysis_of(write_numbered(folder, changed))), key) << kFiles[i].first;
    changed = kFiles;
    changed[i].first += "x";
    const TemporaryFolder renamed;
    EXPECT_NE(content_key(analysis_of(write_numbered(renamed, changed))), key) << kFiles[i].first;
  }
}

TEST_F(NamedFilesTest, AnAnalysisServesBoth) {
  for (const auto& [from, to] : {std::pair{&by_name_, &by_number_}, {&by_number_, &by_name_}}) {
    keep(analysis_of(*from));
    const auto loaded = load_valid(file_, *to, full_analysis().parameters);
    ASSERT_TRUE(std::holds_alternative<analysis::AssetAnalysis>(loaded)) << reason(*to);
    analysis::AssetAnalysis expected = analysis_of(*from);
    expected.asset = to->name;
    expect_same(std::get<analysis::AssetAnalysis>(loaded), expected);
  }
  EXPECT_EQ(by_number_.name, "room.gltf");
}

TEST_F(NamedFilesTest, ChangesOnTheDiskAreNoticed) {
  keep(analysis_of(by_number_));
  EXPECT_EQ(reason(by_number_), "");
  for (const auto& [number, name] :
       {std::pair{"0.gltf", "room.gltf"}, {"1", "sub/x.bin"}, {"2", "a b.png"}}) {
    const std::string before = TemporaryFolder::read(numbered_.path() / number);
    numbered_.write(number, std::string(before.size(), '!'));
    EXPECT_EQ(reason(by_number_), "is stale: '" + std::string(name) + "' has changed");
    numbered_.write(number, before);
    EXPECT_EQ(reason(by_number_), "") << name;
  }
  fs::remove(numbered_.path() / "1");
  EXPECT_EQ(reason(by_number_), "is stale: 'sub/x.bin' is missing or cannot be read now");
  fs::create_directory(numbered_.path() / "1");
  EXPECT_THAT(reason(by_number_), HasSubstr("'sub/x.bin' is missing"));
  fs::remove(numbered_.path() / "1");
  ASSERT_EQ(::mkfifo((numbered_.path() / "1").c_str(), 0600), 0);
  EXPECT_THAT(reason(by_number_), HasSubstr("'sub/x.bin' is missing"));
}

TEST_F(NamedFilesTest, ChangesOfTheTableAreNoticed) {
  keep(analysis_of(by_number_));
  const auto other = [this](const NamedContents& files) {
    const TemporaryFolder folder;
    return reason(write_numbered(folder, files));
  };
  EXPECT_EQ(other(kFiles), "") << "the same sent once more";
  EXPECT_EQ(other({kFiles[0], kFiles[2]}), "is stale: 'sub/x.bin' is missing or cannot be read now");
  EXPECT_EQ(other({kFiles[0], kFiles[1], kFiles[2], {"lost.mtl", ""}}),
            "is stale: 'lost.mtl', missing before, is there now");
  EXPECT_EQ(other({{"other.gltf", "asset"}, kFiles[1], kFiles[2]}), "belongs to another asset ('room.gltf')");
  EXPECT_EQ(other({kFiles[0], {"a b.png", "buffer"}, {"sub/x.bin", "picture"}}),
            "is stale: 'sub/x.bin' has changed");
}

TEST_F(NamedFilesTest, NoOthersAreOpened) {
  const fs::path outside = folder_.write("outside.bin", "secret");
  for (const char* name : {"names", "unnamed.bin"}) fs::copy_file(outside, numbered_.path() / name);
  for (const std::string& name :
       {std::string("1"), std::string("0.gltf"), std::string("names"), std::string("unnamed.bin"),
        std::string("../") + folder_.path().filename().string() + "/outside.bin", outside.string(),
        std::string("sub/../sub/x.bin"), std::string("sub/x.bin\0", 10)})
    EXPECT_FALSE(fingerprint(by_number_, {{name, true}}).at(1).found) << name;
  EXPECT_TRUE(fingerprint(by_name_, {{outside.string(), true}}).at(1).found) << "as the import had it";
}

TEST_F(NamedFilesTest, AnAssetThatCannotBeReadIsCalledByItsName) {
  keep(analysis_of(by_number_));
  fs::remove(by_number_.file);
  try {
    fingerprint(by_number_, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "'room.gltf' cannot be read: No such file or directory");
  }
  EXPECT_THAT(reason(by_number_), testing::AllOf(HasSubstr("cannot be compared with its asset"),
                                                 testing::Not(HasSubstr(numbered_.path().string()))));
}

}  // namespace
}  // namespace scene_analyzer::analysis_file
