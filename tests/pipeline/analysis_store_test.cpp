// What a pipeline asks of a store that it was given, what it tells it, and what it makes of the answers.
#include "pipeline/analysis_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <mutex>
#include <stdexcept>

#include "analysis_file/analysis_file.h"
#include "import/file_names.h"
#include "pipeline/pending_pack.h"
#include "pipeline/pipeline.h"
#include "pipeline/strip.h"
#include "support/numbered_files.h"

namespace scene_analyzer::pipeline {
namespace {

namespace fs = std::filesystem;
using analysis::AssetAnalysis;
using analysis::Metric;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// Answers what it is told to, and remembers what it was asked and told.
class RecordingStore final : public AnalysisStore {
 public:
  struct Asked {
    std::string name;
    fs::path file;
    analysis::Parameters parameters;
    bool operator==(const Asked&) const = default;
  };
  Found find(const mesh::AssetSource& asset, const analysis::Parameters& parameters) override {
    const std::lock_guard lock(mutex_);
    asked.push_back({asset.name, asset.file, parameters});
    const auto answer = answers.find(asset.name);
    return answer == answers.end() ? Found() : answer->second;
  }
  void keep(const mesh::AssetSource& asset, const AssetAnalysis& analysis) override {
    const std::lock_guard lock(mutex_);
    if (refusal) throw analysis_file::CannotStore(*refusal);
    kept.emplace_back(asset.name, analysis);
  }
  fs::path folder_of(const mesh::AssetSource& asset) const override {
    return "folder of " + asset.name.substr(0, 1);
  }

  std::map<std::string, Found> answers;  // by the asset's name
  std::optional<analysis_file::CannotStore> refusal;
  std::vector<Asked> asked;
  std::vector<std::pair<std::string, AssetAnalysis>> kept;

 private:
  std::mutex mutex_;
};

class AnalysisStoreTest : public testing::Test {
 protected:
  AnalysisStoreTest() {
    options_.metrics.reset(index_of(Metric::kRenderingTime));
    options_.store = store_;
    without_.metrics = options_.metrics;
    without_.use_analysis_files = false;
    without_.fingerprint_files = true;
  }

  mesh::AssetSource asset(const std::string& name, int quads = 3) const {
    return {folder_.write(name + ".obj", strip(quads, true)), name};
  }
  Outcome analyze(const mesh::AssetSource& asset) const {
    return Pipeline(options_, shared_device).analyze(asset);
  }
  // With neither a worker nor a device: only the store can help.
  Outcome analyze_from_store(const mesh::AssetSource& asset) const {
    ::setenv("SCENE_ANALYZER_TEST_WORKER", "exit", 1);
    Outcome outcome = Pipeline(options_, no_device).analyze(asset);
    ::unsetenv("SCENE_ANALYZER_TEST_WORKER");
    return outcome;
  }
  AssetAnalysis analyze_without(const mesh::AssetSource& asset) const {
    return Pipeline(without_, shared_device).analyze(asset).analysis.value();
  }
  std::string bytes_of(const AssetAnalysis& analysis) const {
    const TemporaryFolder folder;
    analysis_file::store(folder.path() / "a.analysis", analysis);
    return TemporaryFolder::read(folder.path() / "a.analysis");
  }

  const TemporaryFolder folder_;
  const std::shared_ptr<RecordingStore> store_ = std::make_shared<RecordingStore>();
  Options options_, without_;
};

TEST_F(AnalysisStoreTest, IsAskedFirstAndToldAfter) {
  options_.parameters.alpha_degrees = without_.parameters.alpha_degrees = 30;
  const mesh::AssetSource one = asset("one");
  const Outcome outcome = analyze(one);
  ASSERT_TRUE(outcome.analysis) << outcome.error;
  EXPECT_THAT(store_->asked, ElementsAre(RecordingStore::Asked{"one", one.file, options_.parameters}));
  ASSERT_THAT(store_->kept, SizeIs(1));
  EXPECT_EQ(store_->kept[0].first, "one");
  EXPECT_TRUE(bytes_of(store_->kept[0].second) == bytes_of(*outcome.analysis));
  EXPECT_TRUE(bytes_of(*outcome.analysis) == bytes_of(analyze_without(one))) << "it changes no result";
  EXPECT_FALSE(outcome.from_file);
  EXPECT_TRUE(outcome.kept);
  EXPECT_TRUE(outcome.import);
  EXPECT_THAT(outcome.messages, IsEmpty());
}

TEST_F(AnalysisStoreTest, StandsInPlaceOfAnalysisFiles) {
  options_.cache_folder = folder_.path() / "cache";
  const mesh::AssetSource one = asset("one");
  for (const bool use_analysis_files : {true, false}) {
    options_.use_analysis_files = use_analysis_files;
    EXPECT_TRUE(analyze(one).kept);
  }
  EXPECT_THAT(store_->asked, SizeIs(2));
  EXPECT_THAT(store_->kept, SizeIs(2));
  EXPECT_FALSE(fs::exists(folder_.path() / "cache"));
  EXPECT_FALSE(fs::exists(analysis_file::path_for(one.file, {})));
}

TEST_F(AnalysisStoreTest, AnAnswerSavesTheRest) {
  const mesh::AssetSource one = asset("one");
  EXPECT_FALSE(analyze_from_store(one).analysis) << "the trap holds";
  AssetAnalysis analysis = analyze_without(one);
  store_->answers["one"].analysis = analysis;
  store_->answers["one"].analysis->asset = "as it was called then";
  const Outcome outcome = analyze_from_store(one);
  ASSERT_TRUE(outcome.analysis) << outcome.error;
  EXPECT_TRUE(bytes_of(*outcome.analysis) == bytes_of(analysis)) << "with the name that it has now";
  EXPECT_TRUE(outcome.from_file);
  EXPECT_TRUE(outcome.kept);
  EXPECT_FALSE(outcome.import);
  EXPECT_THAT(outcome.messages, IsEmpty());
  EXPECT_THAT(store_->kept, IsEmpty()) << "it has it";
}

TEST_F(AnalysisStoreTest, AnAnswerThatLacksMetricsIsAddedTo) {
  const mesh::AssetSource one = asset("one");
  without_.metrics.reset().set(index_of(Metric::kPlanarGroupVariation));
  store_->answers["one"].analysis = analyze_without(one);
  options_.metrics.reset().set(index_of(Metric::kCooccurrenceContrast));
  const Outcome outcome = analyze(one);
  EXPECT_FALSE(outcome.from_file);
  EXPECT_THAT(outcome.messages, IsEmpty());
  ASSERT_THAT(store_->kept, SizeIs(1));
  const auto& geometry = store_->kept[0].second.geometries.at(0);
  EXPECT_TRUE(geometry.cooccurrence_contrast);
  EXPECT_TRUE(geometry.planar_group_variation) << "nothing is lost";
  EXPECT_FALSE(geometry.fourier_transform) << "nobody asked for it";
}

TEST_F(AnalysisStoreTest, AnAnswerBeyondTheLimitIsNone) {
  const mesh::AssetSource one = asset("one");
  store_->answers["one"].analysis = analyze_without(one);
  options_.import_limits.triangles = 2;
  const Outcome outcome = analyze(one);
  EXPECT_THAT(outcome.error, HasSubstr("--max-triangles"));
  EXPECT_FALSE(outcome.analysis);
  EXPECT_THAT(store_->kept, IsEmpty());
}

TEST_F(AnalysisStoreTest, WhyAnAnswerDoesNotServeIsSaid) {
  store_->answers["one"].unusable = "what is there is of no use";
  const Outcome outcome = analyze(asset("one"));
  EXPECT_THAT(outcome.messages, ElementsAre("one: what is there is of no use; it is computed again"));
  EXPECT_THAT(store_->kept, SizeIs(1));
}

TEST_F(AnalysisStoreTest, IsNotToldOfAssetsThatCannotBeRead) {
  const Outcome outcome = analyze({folder_.write("bad.obj", "no model"), "bad"});
  EXPECT_THAT(outcome.error, testing::StartsWith("bad: "));
  EXPECT_THAT(store_->asked, SizeIs(1));
  EXPECT_THAT(store_->kept, IsEmpty());
  EXPECT_FALSE(outcome.kept);
}

TEST_F(AnalysisStoreTest, WhatItCannotKeepIsSaidForEachAsset) {
  store_->refusal.emplace("this one is too large", true);
  for (const char* name : {"a1", "a2"}) {
    const Outcome outcome = analyze(asset(name));
    ASSERT_TRUE(outcome.analysis) << outcome.error;
    EXPECT_FALSE(outcome.kept);
    EXPECT_EQ(outcome.write_error, "this one is too large");
    EXPECT_TRUE(outcome.others_can_be_written);
    EXPECT_THAT(outcome.messages, ElementsAre("this one is too large; this analysis is not kept"));
  }
}

TEST_F(AnalysisStoreTest, AFolderWhereNothingCanBeKeptIsSaidOnce) {
  store_->refusal.emplace("the disk is full", false);
  Pipeline pipeline(options_, shared_device);
  for (const auto& [name, messages] : {std::pair{"a1", 1U}, {"a2", 0U}, {"b1", 1U}, {"a3", 0U}}) {
    const Outcome outcome = pipeline.analyze(asset(name));
    EXPECT_TRUE(outcome.analysis) << outcome.error;
    EXPECT_FALSE(outcome.kept);
    EXPECT_EQ(outcome.write_error, "the disk is full");
    EXPECT_FALSE(outcome.others_can_be_written);
    EXPECT_THAT(outcome.messages, SizeIs(messages)) << name;
    for (const std::string& message : outcome.messages) EXPECT_THAT(message, HasSubstr("the disk is full"));
  }
}

TEST_F(AnalysisStoreTest, MayBeTheAssetsOwn) {
  const auto other = std::make_shared<RecordingStore>();
  Options own = options_;
  own.store = other;
  own.parameters.alpha_degrees = 30;
  const std::vector<std::shared_ptr<const Options>> given = {
      nullptr, std::make_shared<const Options>(own), std::make_shared<const Options>(without_), nullptr};
  const AssetAnalysis known = analyze_without(asset("a3", 6));
  store_->answers["a3"].analysis = known;
  Pipeline pipeline(options_, shared_device);
  std::vector<std::unique_ptr<PendingAnalysis>> prepared;
  for (int i = 0; i < 4; ++i)
    prepared.push_back(
        pipeline.prepare(asset("a" + std::to_string(i), i + 3), {}, given[static_cast<std::size_t>(i)]));
  std::vector<Outcome> outcomes;
  pipeline.finish_pack(pipeline.start_pack(std::move(prepared)),
                       [&](std::size_t, Outcome outcome) { outcomes.push_back(std::move(outcome)); });
  ASSERT_THAT(outcomes, SizeIs(4));
  for (const Outcome& outcome : outcomes) EXPECT_TRUE(outcome.analysis) << outcome.error;
  EXPECT_TRUE(outcomes[3].from_file);
  EXPECT_FALSE(outcomes[2].kept);
  ASSERT_THAT(store_->asked, SizeIs(2));
  EXPECT_EQ(store_->asked[0].name, "a0");
  EXPECT_EQ(store_->asked[1].name, "a3");
  ASSERT_THAT(store_->kept, SizeIs(1));
  EXPECT_EQ(store_->kept[0].first, "a0");
  ASSERT_THAT(other->asked, SizeIs(1));
  EXPECT_EQ(other->asked[0].parameters.alpha_degrees, 30);
  ASSERT_THAT(other->kept, SizeIs(1));
  EXPECT_EQ(other->kept[0].first, "a1");
  EXPECT_EQ(other->kept[0].second.parameters, own.parameters);
}

// Such assets are why there are other stores.
TEST_F(AnalysisStoreTest, IsGivenAssetsWhoseFilesLieUnderNumbers) {
  const NamedContents files = {{"strip.obj", "mtllib parts/a.mtl\nusemtl red\n" + strip(3, true)},
                               {"unused", "nothing"},
                               {"parts/a.mtl", "newmtl red\nKd 1 0 0\n"}};
  const TemporaryFolder named, numbered;
  const mesh::AssetSource by_number = write_numbered(numbered, files);
  import::write_file_names(numbered.path(), *by_number.file_names);
  const mesh::AssetSource by_name(write_named(named, files), "strip.obj");
  const Outcome outcome = analyze(by_number);
  ASSERT_TRUE(outcome.analysis) << outcome.error;
  EXPECT_THAT(outcome.messages, IsEmpty());
  EXPECT_EQ(store_->asked.at(0), (RecordingStore::Asked{"strip.obj", by_number.file, options_.parameters}));
  const AssetAnalysis expected = analyze_without(by_name);
  ASSERT_THAT(expected.files, SizeIs(2));
  EXPECT_TRUE(bytes_of(store_->kept.at(0).second) == bytes_of(expected));
  EXPECT_EQ(analysis_file::content_key(store_->kept[0].second), analysis_file::content_key(expected));
}

}  // namespace
}  // namespace scene_analyzer::pipeline
