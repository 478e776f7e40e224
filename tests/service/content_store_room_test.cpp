// What a full store loses first, how many analyses one asset may have, and what a killed service leaves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "files/temporary_name.h"
#include "service/kept_analyses.h"

namespace scene_analyzer::service {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

class FullStoreTest : public ContentStoreTest {
 protected:
  // Assets "0" to "4", whose analyses take the same room.
  FullStoreTest() {
    for (const char* one : {"0", "1", "2", "3", "4"}) {
      assets_.push_back(sent({{"a.obj", one}}));
      analyses_.push_back(analysis_of(*assets_.back().asset, one));
    }
    keep(0);
    size_ = store_->bytes();
  }
  void keep(std::size_t i) { store_->keep(*assets_[i].asset, analyses_[i]); }
  // Which of them are there, without using them.
  std::string there() const {
    std::string all;
    for (std::size_t i = 0; i < analyses_.size(); ++i)
      if (fs::exists(folder_.path() / "store") && is_kept(analyses_[i])) all += std::to_string(i);
    return all;
  }
  // Used that many hours ago.
  void set_age(std::size_t i, int hours) const {
    fs::last_write_time(file_of(analyses_[i]), fs::file_time_type::clock::now() - std::chrono::hours(hours));
  }

  std::vector<Sent> assets_;
  std::vector<AssetAnalysis> analyses_;
  std::uint64_t size_ = 0;

 private:
  bool is_kept(const AssetAnalysis& analysis) const {
    const fs::path part = folder_.path() / "store" / analysis_file::content_key(analysis).substr(0, 2);
    return fs::exists(part) && !file_of(analysis).empty();
  }
};

TEST_F(FullStoreTest, CountsWhatItHolds) {
  EXPECT_EQ(size_, fs::file_size(file_of(analyses_[0])));
  keep(0);
  EXPECT_EQ(store_->bytes(), size_) << "it is the same";
  keep(1);
  EXPECT_EQ(store_->bytes(), 2 * size_);
  EXPECT_EQ(store_->size(), 2U);
  AssetAnalysis longer = analyses_[0];
  longer.warnings = {std::string(1000, 'w')};
  store_->keep(*assets_[0].asset, longer);
  EXPECT_EQ(store_->size(), 2U);
  EXPECT_EQ(store_->bytes(), size_ + fs::file_size(file_of(longer)));
  open();
  EXPECT_EQ(store_->bytes(), size_ + fs::file_size(file_of(longer)));
}

TEST_F(FullStoreTest, WhatWasUsedLongestAgoGoesFirst) {
  open(3 * size_);
  for (const std::size_t i : {1U, 2U}) keep(i);
  EXPECT_EQ(there(), "012");
  keep(3);
  EXPECT_EQ(there(), "123") << "in the order of storing";
  EXPECT_EQ(found(*assets_[1].asset), "1");
  keep(4);
  EXPECT_EQ(there(), "134") << "who is found is used";
  EXPECT_EQ(got(analyses_[3]), "3");
  keep(0);
  EXPECT_EQ(there(), "034") << "and who is got";
  EXPECT_EQ(found(*assets_[1].asset), "");
  EXPECT_EQ(got(analyses_[1]), "");
  keep(4);  // again
  keep(2);
  EXPECT_EQ(there(), "024") << "and who is stored again";
  EXPECT_EQ(store_->size(), 3U);
  EXPECT_EQ(store_->bytes(), 3 * size_);
}

TEST_F(FullStoreTest, OneAnalysisMayMakeSeveralGo) {
  open(4 * size_);
  for (const std::size_t i : {1U, 2U, 3U}) keep(i);
  AssetAnalysis large = analyses_[4];
  large.warnings = {std::string(static_cast<std::size_t>(size_ + size_ / 2), 'w')};
  store_->keep(*assets_[4].asset, large);
  EXPECT_EQ(there(), "34");
  EXPECT_LE(store_->bytes(), 4 * size_);
}

TEST_F(FullStoreTest, WhatIsLargerThanTheStoreIsNotKept) {
  open(size_);
  AssetAnalysis large = analyses_[1];
  large.warnings = {std::string(1000, 'w')};
  store_->keep(*assets_[1].asset, large);
  EXPECT_EQ(there(), "");
  EXPECT_EQ(store_->size(), 0U);
  EXPECT_EQ(store_->bytes(), 0U);
  keep(2);
  EXPECT_EQ(found(*assets_[2].asset), "2");
}

TEST_F(FullStoreTest, WithLessRoomAtTheStartTheOldestGo) {
  for (const std::size_t i : {1U, 2U, 3U, 4U}) keep(i);
  for (const auto& [i, hours] : {std::pair{0U, 3}, {1U, 5}, {2U, 1}, {3U, 4}, {4U, 2}}) set_age(i, hours);
  open(3 * size_);
  EXPECT_EQ(there(), "024");
  keep(1);
  EXPECT_EQ(there(), "124") << "the order of use outlives the service";
}

TEST_F(FullStoreTest, UseOutlivesTheService) {
  for (const std::size_t i : {1U, 2U, 3U}) keep(i);
  for (const std::size_t i : {0U, 1U, 2U, 3U}) set_age(i, 10 - static_cast<int>(i));
  EXPECT_EQ(found(*assets_[0].asset), "0");
  EXPECT_EQ(got(analyses_[1]), "1");
  open(2 * size_);
  EXPECT_EQ(there(), "01");
}

TEST_F(FullStoreTest, LeftoversOfInterruptedWritesAreRemovedAtTheStart) {
  keep(1);
  const fs::path part = file_of(analyses_[0]).parent_path();
  analysis_file::write_text(part / files::temporary_name(), "half an anal");
  analysis_file::write_text(part / files::temporary_name(), TemporaryFolder::read(file_of(analyses_[0])));
  open();
  EXPECT_THAT(everything_below(part), SizeIs(testing::AllOf(testing::Ge(1), testing::Le(2))));
  EXPECT_EQ(store_->size(), 2U);
  EXPECT_EQ(store_->bytes(), 2 * size_);
}

TEST_F(FullStoreTest, WhatIsNoAnalysisOfTheStoreIsLeftAlone) {
  const fs::path store = folder_.path() / "store", file = file_of(analyses_[0]);
  const std::string name = file.filename().string(), bytes = TemporaryFolder::read(file);
  const std::string first = name.substr(0, 1) == "0" ? "1" : "0";
  fs::create_directories(store / "lost+found");
  fs::create_directory_symlink(store / name.substr(0, 2), store / "zz");
  const std::vector<fs::path> foreign = {store / name,
                                         store / "lost+found" / name,
                                         store / "lost+found" / files::temporary_name(),
                                         file.parent_path() / ("x" + name),
                                         file.parent_path() / (first + name.substr(1)),
                                         file.parent_path() / (name.substr(0, 40) + ".analysis"),
                                         file.parent_path() / "note.txt"};
  for (const fs::path& one : foreign) analysis_file::write_text(one, bytes);
  open();
  EXPECT_EQ(store_->size(), 1U);
  open(0);
  EXPECT_FALSE(fs::exists(file));
  for (const fs::path& one : foreign) EXPECT_TRUE(fs::exists(one)) << one;
}

// Assets that look the same before the import: the files that they refer to differ.
class AlikeTest : public ContentStoreTest {
 protected:
  static constexpr std::size_t kAlike = 9;  // one more than are looked at
  AlikeTest() {
    for (std::size_t i = 0; i < kAlike; ++i)
      assets_.push_back(
          sent({{"room.gltf", "asset"}, {"x.bin", std::string(1, static_cast<char>('0' + i))}}));
  }
  AssetAnalysis keep(std::size_t i) {
    return ContentStoreTest::keep(*assets_[i].asset, std::to_string(i), {{"x.bin", true}});
  }
  // Which of them are found.
  std::string found() {
    std::string all;
    for (const Sent& one : assets_) all += ContentStoreTest::found(*one.asset);
    return all;
  }

  std::vector<Sent> assets_;
};

TEST_F(AlikeTest, TheNewestEightAreFoundAndAllAreGotByTheirKeys) {
  std::vector<AssetAnalysis> kept;
  for (std::size_t i = 0; i < kAlike; ++i) kept.push_back(keep(i));
  EXPECT_EQ(store_->size(), kAlike);
  EXPECT_EQ(found(), "12345678");
  for (std::size_t i = 0; i < kAlike; ++i) EXPECT_EQ(got(kept[i]), std::to_string(i));
}

TEST_F(AlikeTest, OneThatIsKeptAgainIsTheNewest) {
  for (std::size_t i = 0; i < kAlike; ++i) keep(i);
  keep(0);
  EXPECT_EQ(found(), "02345678") << "or it would be computed again for ever";
  keep(3);
  keep(1);
  EXPECT_EQ(found(), "01345678") << "the one before has become newer";
}

TEST_F(AlikeTest, AllOfThemMayGo) {
  std::vector<AssetAnalysis> kept;
  for (std::size_t i = 0; i < kAlike; ++i) kept.push_back(keep(i));
  EXPECT_EQ(got(kept[0]), "0");  // the last one to go is the one that is not found any more
  for (std::size_t i = 1; i < kAlike; ++i) {
    fs::remove(file_of(kept[i]));
    EXPECT_EQ(got(kept[i]), "");
  }
  fs::remove(file_of(kept[0]));
  EXPECT_EQ(got(kept[0]), "");
  EXPECT_EQ(store_->size(), 0U);
  keep(4);
  EXPECT_EQ(found(), "4");
}

// A store of small and large analyses, written by a child until it is killed.
class KilledStoreTest : public ContentStoreTest {
 protected:
  fs::path place() const { return folder_.path() / "killed"; }

  [[noreturn]] void store_for_ever(AssetAnalysis analysis, int round) const try {
    ContentStore store(place(), kPlenty);
    for (std::uint64_t i = 0;; ++i) {
      analysis.files[0].hash = {static_cast<std::uint64_t>(round), i};
      store.keep("a.obj", analysis);
    }
  } catch (...) {
    ::_exit(1);  // the test is the parent's
  }
  // Whole ones and others.
  std::size_t files() const {
    if (!fs::exists(place())) return 0;
    const auto all = everything_below(place());
    return static_cast<std::size_t>(
        std::ranges::count_if(all, [](const std::string& name) { return name.find('/') != name.npos; }));
  }
};

TEST_F(KilledStoreTest, LeavesNothingThatIsTakenForAnAnalysis) {
  AssetAnalysis analysis = analysis_of(*sent({{"a.obj", "asset"}}).asset, "mark");
  analysis_file::replace_geometries(analysis, 2000);
  std::size_t leftovers = 0;
  for (int round = 0; round < 10; ++round) {
    const std::size_t before = files();
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) store_for_ever(analysis, round);
    int status = 0;
    while (files() < before + 2 + static_cast<std::size_t>(round) % 3) {
      ASSERT_EQ(::waitpid(child, &status, WNOHANG), 0) << "the child has ended by itself";
      std::this_thread::yield();
    }
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the child has to be killed, not to end";
    const std::size_t left = files();
    ContentStore store(place(), kPlenty);
    leftovers += left - files();
    EXPECT_EQ(store.size(), files());
    std::uint64_t bytes = 0;
    for (const std::string& name : everything_below(place())) {
      if (name.find('/') == name.npos) continue;
      bytes += fs::file_size(place() / name);
      EXPECT_TRUE(store.get(fs::path(name).filename().string().substr(0, 32))) << name;
    }
    EXPECT_EQ(store.bytes(), bytes);
    EXPECT_GT(store.size(), before);
  }
  std::printf("of 10 kills, %zu in the middle of a file\n", leftovers);
}

}  // namespace
}  // namespace scene_analyzer::service
