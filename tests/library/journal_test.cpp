// What became of assets: written at once, found again after a killed run, replaced by a whole journal.
#include "library/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>

#include "base/error.h"
#include "library/output_folder.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::library {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Record full_record(const std::string& asset, const std::string& finished) {
  return {.asset = asset,
          .status = Status::kAnalysed,
          .reason = "none",
          .analysis = "analyses/" + asset + ".analysis",
          .content_key = "0123456789abcdef0123456789abcdef",
          .bytes = 5'000'000'000,
          .meshes = 3,
          .triangles = 12,
          .import_seconds = 0.1 + 0.2,
          .seconds = 1e-9,
          .warnings = {"first", "second"},
          .warning_count = 20,
          .finished = finished};
}

class JournalTest : public testing::Test {
 protected:
  JournalTest() { prepare_folder(out()); }
  fs::path out() const { return folder_.path() / "out"; }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(journal_folder(out())))
      names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }

  TemporaryFolder folder_;
};

TEST(Record, ComesBackAsItWas) {
  const std::string odd = std::string("na\xff\"me\n") + '\x01' + "\xc3\xa4";
  const Record record = full_record(odd, "2026-01-31T12:00:00.000Z");
  const std::string line = to_line(record);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_EQ(record_of(line), record);
  Record failed{.asset = "x", .status = Status::kFailed, .reason = "x: is empty"};
  EXPECT_EQ(record_of(to_line(failed)), failed);
}

TEST(Record, WhatIsNoRecordIsNone) {
  const std::string line = to_line(full_record("a", "b"));
  for (std::size_t length = 0; length < line.size(); ++length)
    EXPECT_FALSE(record_of(line.substr(0, length))) << length;
  for (const char* other : {"", "{}", "[]", "null", "{\"asset\":1}", "no JSON"})
    EXPECT_FALSE(record_of(other));
  EXPECT_FALSE(record_of(std::string(line).replace(line.find("analysed"), 8, "whatever")));
}

TEST(Record, TimesAreInOrderAsText) {
  const std::string first = utc_now();
  EXPECT_THAT(first, testing::MatchesRegex("20..-..-..T..:..:..\\....Z"));
  EXPECT_LE(first, utc_now());
}

TEST_F(JournalTest, IsReplacedByAWholeOneInTheLibrarysOrder) {
  Journal journal(out(), {1, 3});
  journal.add(full_record("b", "2"));
  journal.add(full_record("a", "1"));
  EXPECT_EQ(files().size(), 1U);
  journal.finish(std::vector<std::string>{"a", "b", "never analysed"});
  EXPECT_THAT(files(), ElementsAre("shard-00001-of-00003.jsonl"));
  const std::string text = TemporaryFolder::read(journal_folder(out()) / files().front());
  EXPECT_LT(text.find("\"asset\":\"a\""), text.find("\"asset\":\"b\""));
  EXPECT_EQ(std::ranges::count(text, '\n'), 2);
}

TEST_F(JournalTest, WhatAKilledRunHasWrittenIsFound) {
  {
    Journal killed(out(), {});
    killed.add(full_record("a", "1"));
    killed.add(full_record("b", "1"));
  }
  const fs::path file = journal_folder(out()) / files().front();
  fs::resize_file(file, fs::file_size(file) - 10);
  const Journals before = read_journals(out(), 1);
  EXPECT_EQ(before.records.size(), 1U);
  EXPECT_THAT(before.warnings, IsEmpty()) << "a line that is cut off at the end is no damage";
  Journal next(out(), {});
  EXPECT_NE(next.find("a"), nullptr);
  EXPECT_EQ(next.find("b"), nullptr);
  next.add(full_record("b", "2"));
  next.finish(std::vector<std::string>{"a", "b"});
  EXPECT_THAT(files(), ElementsAre("shard-00000-of-00001.jsonl"));
  EXPECT_EQ(read_journals(out(), 1).records.at("a"), full_record("a", "1"));
}

TEST_F(JournalTest, TheLatestRecordOfAnAssetCounts) {
  Journal one(out(), {0, 2}), other(out(), {1, 2});
  one.add(full_record("a", "2"));
  other.add(full_record("a", "3"));
  one.add(full_record("b", "5"));
  other.add(full_record("b", "4"));
  const Journals journals = read_journals(out(), 2);
  EXPECT_EQ(journals.records.at("a").finished, "3");
  EXPECT_EQ(journals.records.at("b").finished, "5");
}

TEST_F(JournalTest, TheSameTaskTwiceAtOnceLosesNothing) {
  Journal one(out(), {}), other(out(), {});
  const std::vector<std::string> assets = {"a", "b"};
  one.add(full_record("a", "1"));
  other.add(full_record("a", "1"));
  one.add(full_record("b", "1"));
  one.finish(assets);
  other.add(full_record("b", "1"));
  other.finish(assets);
  EXPECT_THAT(files(), ElementsAre("shard-00000-of-00001.jsonl"));
  EXPECT_EQ(read_journals(out(), 1).records.size(), 2U);
}

TEST_F(JournalTest, WhatARunElsewhereHasAddedMeanwhileIsKept) {
  Journal mine(out(), {});
  mine.add(full_record("a", "1"));
  const fs::path elsewhere = journal_folder(out()) / "shard-00000-of-00001.another.7.x.running.jsonl";
  std::ofstream(elsewhere) << to_line(full_record("a", "2")) << '\n'
                           << to_line(full_record("b", "2")) << '\n';
  mine.finish(std::vector<std::string>{"a", "b"});
  EXPECT_EQ(read_journals(out(), 1).records.at("a").finished, "2");
  EXPECT_EQ(read_journals(out(), 1).records.size(), 2U);
  EXPECT_TRUE(fs::exists(elsewhere)) << "that run may go on";
  fs::last_write_time(elsewhere, fs::file_time_type::clock::now() - std::chrono::hours(24 * 8));
  Journal(out(), {}).finish(std::vector<std::string>{"a", "b"});
  EXPECT_FALSE(fs::exists(elsewhere)) << "silent for so long, it is over";
}

TEST_F(JournalTest, MergingBesideRunsThatEndMissesNothing) {
  const std::vector<std::string> assets = {"a", "b"};
  {
    Journal first(out(), {});
    first.add(full_record("a", "1"));
    first.add(full_record("b", "1"));
    first.finish(assets);
  }
  std::atomic<bool> over = false;
  std::jthread writer([&] {
    for (int i = 0; i < 200; ++i) {
      Journal journal(out(), {});
      journal.add(full_record("a", "2"));
      journal.finish(assets);
    }
    over = true;
  });
  do {
    ASSERT_EQ(read_journals(out(), 1).records.size(), 2U);
  } while (!over);
}

TEST_F(JournalTest, ADamagedLineIsNamedAndTheOthersCount) {
  std::ofstream(journal_folder(out()) / "shard-00000-of-00001.jsonl")
      << to_line(full_record("a", "1")) << "\nnonsense\n"
      << to_line(full_record("b", "1")) << '\n';
  const Journals journals = read_journals(out(), 1);
  EXPECT_EQ(journals.records.size(), 2U);
  EXPECT_THAT(journals.warnings, ElementsAre(HasSubstr("line 2 is no record")));
}

TEST_F(JournalTest, AFolderThatCannotBeWrittenIsAWrongRequest) {
  EXPECT_THROW(prepare_folder("/proc/no-such-folder"), UsageError);
  EXPECT_THROW(write_manifest("/proc", {}), UsageError);
}

TEST_F(JournalTest, TheManifestComesBackAsItWas) {
  Manifest manifest;
  manifest.tool_version = "0.1.0";
  manifest.parameters = {12.5, 300, 1e-7, 4, 5'000'000'002};
  manifest.metrics.set(0).set(3);
  manifest.shard_count = 2;
  manifest.assets = {{"a\xff.glb", 7}, {"b.glb", 5'000'000'000}};
  manifest.shards = {1, 0};
  write_manifest(out(), manifest);
  EXPECT_EQ(read_manifest(out()), manifest);
  const auto written = fs::last_write_time(out() / "library.jsonl");
  write_manifest(out(), manifest);
  EXPECT_EQ(fs::last_write_time(out() / "library.jsonl"), written)
      << "it was written although it says the same";
}

TEST_F(JournalTest, ADamagedManifestIsNamed) {
  const auto refusal = [&](const std::string& text) -> std::string {
    std::ofstream(out() / "library.jsonl") << text;
    try {
      read_manifest(out());
    } catch (const UsageError& error) {
      return error.what();
    }
    return "none";
  };
  Manifest manifest;
  manifest.assets = {{"a", 1}, {"b", 2}};
  manifest.shards = {0, 0};
  write_manifest(out(), manifest);
  const std::string whole = TemporaryFolder::read(out() / "library.jsonl");
  EXPECT_EQ(refusal(whole), "none");
  for (std::size_t length = 0; length + 1 < whole.size(); ++length)
    EXPECT_THAT(refusal(whole.substr(0, length)), HasSubstr("library.jsonl: cannot be understood")) << length;
  fs::remove(out() / "library.jsonl");
  EXPECT_THROW(read_manifest(out()), UsageError);
}

}  // namespace
}  // namespace scene_analyzer::library
