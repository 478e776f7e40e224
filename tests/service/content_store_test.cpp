// Analyses by what they are analyses of: who finds which.
#include "service/content_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "service/kept_analyses.h"

namespace scene_analyzer::service {
namespace {

using analysis::Metric;
using testing::AllOf;
using testing::HasSubstr;

TEST_F(ContentStoreTest, TheSameFilesAreFoundWhoeverHasThem) {
  const Files files = {{"room.gltf", "asset"}, {"sub/x.bin", "buffer"}};
  const std::vector<mesh::ReferencedFile> references = {{"sub/x.bin", true}, {"lost.mtl", false}};
  const fs::path on_disk = folder_.write("room.gltf", "asset");
  fs::create_directory(folder_.path() / "sub");
  folder_.write("sub/x.bin", "buffer");
  const Sent first = sent(files), second = sent({files[0], {"unused.png", "more"}, files[1]});

  EXPECT_EQ(found(*first.asset), "");
  const AssetAnalysis kept = keep(*first.asset, "kept", references);
  EXPECT_EQ(found(*first.asset), "kept");
  EXPECT_EQ(found(*second.asset), "kept");
  EXPECT_EQ(found(on_disk), "kept");
  EXPECT_EQ(store_->find(on_disk, kept.parameters).analysis->asset, on_disk.string())
      << "as it is called now";
  EXPECT_EQ(store_->find(*second.asset, kept.parameters).analysis->asset, "room.gltf");
  EXPECT_EQ(got(kept), "kept");
  EXPECT_EQ(store_->size(), 1U);

  open();
  EXPECT_EQ(found(on_disk), "kept");
  keep(on_disk, "newer", references);
  EXPECT_EQ(found(*first.asset), "newer");
  EXPECT_EQ(store_->size(), 1U);
}

TEST_F(ContentStoreTest, EveryPartOfAnAnalysisComesBack) {
  const Sent one = sent({{"a.obj", "asset"}});
  const AssetAnalysis kept = keep(*one.asset, "kept");
  AssetAnalysis expected = kept;
  expected.asset = "a.obj";
  const auto found = store_->find(*one.asset, kept.parameters);
  ASSERT_TRUE(found.analysis);
  analysis_file::expect_same(*found.analysis, expected);
  const auto got = store_->get(analysis_file::content_key(kept));
  ASSERT_TRUE(got);
  analysis_file::expect_same(*got, kept);
}

TEST_F(ContentStoreTest, OtherFilesAreNotFound) {
  const Files files = {{"room.gltf", "asset"}, {"x.bin", "buffer"}};
  keep(*sent(files).asset, "kept", {{"x.bin", true}, {"lost.mtl", false}});
  EXPECT_EQ(found(*sent({{"house.gltf", "asset"}, files[1]}).asset), "") << "another name";
  EXPECT_EQ(found(*sent({{"room.gltf", "Asset"}, files[1]}).asset), "") << "another byte";
  EXPECT_EQ(found(*sent({{"room.gltf", "asset "}, files[1]}).asset), "") << "one more byte";
  EXPECT_EQ(found(*sent({files[0], {"x.bin", "Buffer"}}).asset), "") << "another byte of a reference";
  EXPECT_EQ(found(*sent({files[0], {"y.bin", "buffer"}}).asset), "") << "under another name";
  EXPECT_EQ(found(*sent({files[0]}).asset), "") << "missing now";
  EXPECT_EQ(found(*sent({files[0], files[1], {"lost.mtl", ""}}).asset), "") << "missing before";
  EXPECT_EQ(found(*sent(files).asset), "kept");
  EXPECT_EQ(found(folder_.path() / "none.gltf"), "") << "the import says what is wrong";
}

TEST_F(ContentStoreTest, OtherParametersAreNotFound) {
  const Sent one = sent({{"a.obj", "asset"}});
  const analysis::Parameters own = keep(*one.asset, "kept").parameters;
  analysis::Parameters other = own;
  other.alpha_degrees += 1;
  EXPECT_EQ(found(*one.asset, other), "");
  other = own;
  other.dim += 1;
  EXPECT_EQ(found(*one.asset, other), "");
  other = own;
  other.weld_tolerance *= 2;
  EXPECT_EQ(found(*one.asset, other), "");
  other = own;
  other.steps += 1;
  other.start_searches += 1;
  EXPECT_EQ(found(*one.asset, other), "kept") << "neither is part of what is kept";
  EXPECT_EQ(store_->find(*one.asset, other).analysis->parameters, other);
}

TEST_F(ContentStoreTest, StartSearchesCountWhereTheSignalWasAnalysed) {
  const Sent one = sent({{"a.obj", "asset"}});
  AssetAnalysis with_signal = analysis_of(*one.asset, "with signal");
  with_signal.computed.set(index_of(Metric::kFourierTransform));
  store_->keep(*one.asset, with_signal);
  EXPECT_EQ(found(*one.asset), "with signal");
  analysis::Parameters other = with_signal.parameters;
  other.start_searches += 1;
  EXPECT_EQ(found(*one.asset, other), "");
}

TEST_F(ContentStoreTest, TheFullestOfTwoIsPreferred) {
  const Sent one = sent({{"a.obj", "asset"}});
  AssetAnalysis fuller = analysis_of(*one.asset, "fuller");
  fuller.computed.set(index_of(Metric::kFourierTransform));
  for (const bool fuller_first : {true, false}) {
    if (fuller_first) store_->keep(*one.asset, fuller);
    keep(*one.asset, "less");
    if (!fuller_first) store_->keep(*one.asset, fuller);
    EXPECT_EQ(store_->size(), 2U);
    EXPECT_EQ(found(*one.asset), "fuller");
    open(0);  // which removes them
    EXPECT_EQ(store_->size(), 0U);
    open();
  }
}

TEST_F(ContentStoreTest, OneServiceAtATimeHasAFolder) {
  try {
    const ContentStore second(folder_.path() / "store", kPlenty);
    FAIL() << "two have it";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("--store"), HasSubstr("another service"),
                                    HasSubstr((folder_.path() / "store").string())));
  }
  keep(*sent({{"a.obj", "asset"}}).asset, "kept");
  store_.reset();
  EXPECT_EQ(ContentStore(folder_.path() / "store", kPlenty).size(), 1U);
}

TEST_F(ContentStoreTest, AFolderThatCannotBeUsedIsNamed) {
  const fs::path file = folder_.write("file", "");
  for (const fs::path& bad : {file, file / "below"}) try {
      const ContentStore store(bad, kPlenty);
      FAIL() << bad;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("--store"), HasSubstr(bad.string())));
    }
}

TEST_F(ContentStoreTest, MissingFoldersAreMade) {
  const ContentStore store(folder_.path() / "several/folders/deep", kPlenty);
  EXPECT_TRUE(fs::is_directory(folder_.path() / "several/folders/deep"));
  EXPECT_EQ(store.folder_of("a.obj"), folder_.path() / "several/folders/deep");
}

TEST_F(ContentStoreTest, KeysThatNobodyHasAreNoAnswer) {
  const AssetAnalysis kept = keep(*sent({{"a.obj", "asset"}}).asset, "kept");
  const std::string key = analysis_file::content_key(kept);
  for (const std::string& other : {std::string(), key.substr(1), key + "0", std::string(32, '0'),
                                   std::string("../store/") + key, file_of(kept).string()})
    EXPECT_FALSE(store_->get(other)) << other;
}

TEST_F(ContentStoreTest, DamagedFilesAreNoAnswer) {
  const Sent one = sent({{"a.obj", "asset"}});
  const AssetAnalysis kept = keep(*one.asset, "kept");
  const std::string whole = TemporaryFolder::read(file_of(kept));
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
  for (const std::string& damaged : {flipped, whole.substr(0, whole.size() / 2), std::string()}) {
    analysis_file::write_text(file_of(kept), damaged);
    open();
    EXPECT_EQ(found(*one.asset), "");
    EXPECT_EQ(got(kept), "");
    EXPECT_EQ(store_->size(), 0U) << "it only takes room";
    EXPECT_EQ(store_->bytes(), 0U);
    keep(*one.asset, "kept");
    EXPECT_EQ(found(*one.asset), "kept");
    EXPECT_EQ(got(kept), "kept");
  }
}

TEST_F(ContentStoreTest, FilesThatSomebodyRemovedAreNoAnswer) {
  const Sent one = sent({{"a.obj", "asset"}});
  const AssetAnalysis kept = keep(*one.asset, "kept");
  fs::remove(file_of(kept));
  EXPECT_EQ(found(*one.asset), "");
  EXPECT_EQ(got(kept), "");
  keep(*one.asset, "again");
  EXPECT_EQ(found(*one.asset), "again");
}

}  // namespace
}  // namespace scene_analyzer::service
