// A library's analyses as one scene, against rating the same analyses all at once.
#include "library/merge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "analysis_file/analysis_file.h"
#include "base/error.h"
#include "base/version.h"
#include "library/journal.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::library {
namespace {

namespace fs = std::filesystem;
using analysis::AssetAnalysis;
using analysis::Metric;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// Three meshes, the last of which has the same shape in all assets.
AssetAnalysis sample(const std::string& asset, int seed) {
  AssetAnalysis analysis;
  analysis.asset = asset;
  analysis.format = "test";
  analysis.computed.set();
  analysis.device = {"GPU", "driver", "discrete"};
  for (std::uint32_t i = 0; i < 3; ++i) {
    analysis::GeometryAnalysis geometry;
    geometry.mesh = i;
    geometry.source_triangles = geometry.triangles =
        i == 2 ? 500 : static_cast<std::uint64_t>(10 * seed + 7 * i + 3);
    geometry.surface_area = i == 2 ? 4 : 0.5 * seed + i + 1;
    geometry.shape_hash = i == 2 ? std::array<std::uint64_t, 2>{1, 2}
                                 : std::array<std::uint64_t, 2>{static_cast<std::uint64_t>(seed), i};
    geometry.planar_groups = geometry.components = geometry.isolated_triangles = 1;
    geometry.largest_planar_group = geometry.boundary_edges = geometry.non_manifold_edges =
        geometry.area_classes = 1;
    geometry.polygons_per_planar_group = 1.0 / (seed + i + 1);
    geometry.planar_group_variation = 0.25;
    geometry.cooccurrence_contrast = 0.1 * i;
    geometry.fourier_transform = 0.5;
    geometry.signal.emplace().length = 2;
    geometry.defects.emplace().found = {{analysis::Defect::kNonManifoldEdges, 1, {0}},
                                        {analysis::Defect::kBoundaryEdges, 1, {0}},
                                        {analysis::Defect::kIsolatedTriangles, 1, {1}}};
    analysis.geometries.push_back(geometry);
    analysis::InstanceAnalysis instance;
    instance.geometry = i;
    instance.node = "node " + std::to_string(i);
    instance.mesh = "mesh";
    instance.bounds = analysis::Bounds{{0, 0, 0}, {1, 1, 1.0 * seed}};
    analysis.instances.push_back(instance);
  }
  analysis.files = {{fs::path(asset).filename().string(), true, 100, {static_cast<std::uint64_t>(seed), 9}}};
  analysis::RenderTiming timing;
  timing.conditions.device = {"GPU", "driver", "discrete", "number " + std::to_string(seed % 2)};
  timing.timestamp_period_ns = timing.budget_seconds = 1;
  for (int i = 0; i < 3; ++i) {
    analysis::RenderingTime time;
    time.mean_ns = time.fastest_ns = time.slowest_ns = 1000 * seed + i;
    time.rounds = time.rotations = 1;
    timing.times.push_back(time);
  }
  analysis.timings = {timing};
  return analysis;
}

// Exit status of the validator over one document; its findings go to the test's output.
int validate(const fs::path& document) {
  const std::string source = SCENE_ANALYZER_SOURCE_DIR;
  const std::string command = "/usr/bin/python3 '" + source + "/tests/report/validate_report.py' '" + source +
                              "/docs/schema/library-v1.schema.json' '" + document.string() + "'";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class MergeTest : public testing::Test {
 protected:
  void keep(const std::vector<AssetAnalysis>& analyses, std::uint32_t shards = 1) {
    prepare_folder(out());
    Manifest manifest;
    manifest.tool_version = version();
    manifest.metrics.set();
    manifest.shard_count = shards;
    std::vector<Record> records;
    for (const AssetAnalysis& analysis : analyses) {
      Record record{.asset = analysis.asset, .status = Status::kAnalysed};
      record.analysis = "analyses/" + analysis.asset + ".analysis";
      record.content_key = analysis_file::content_key(analysis);
      record.bytes = 100;
      record.metrics.set();
      record.finished = utc_now();
      analysis_file::store(out() / record.analysis, analysis);
      manifest.shards.push_back(static_cast<std::uint32_t>(manifest.assets.size()) % shards);
      manifest.assets.push_back({analysis.asset, 100});
      records.push_back(record);
    }
    write_manifest(out(), manifest);
    for (std::uint32_t shard = 0; shard < shards; ++shard) {
      Journal journal(out(), {shard, shards});
      std::vector<std::string> names;
      for (std::size_t i = shard; i < records.size(); i += shards) {
        journal.add(records[i]);
        names.push_back(records[i].asset);
      }
      journal.finish(names);
    }
  }
  std::vector<AssetAnalysis> samples(int count) {
    std::vector<AssetAnalysis> analyses;
    for (int i = 0; i < count; ++i)
      analyses.push_back(sample("asset" + std::to_string(1000 + i) + ".glb", i + 1));
    return analyses;
  }
  fs::path out() const { return folder_.path() / "out"; }
  Merged merged(const MergeOptions& options = {}) { return merge(out(), options, warnings_); }
  std::vector<std::string> lacking() {
    try {
      merged();
    } catch (const Incomplete& error) {
      return error.lines();
    }
    return {};
  }
  std::string json(const Merged& library, std::size_t top = 3) {
    return summary_json(library, top_offenders(out(), library, top), top);
  }
  std::string table(const Merged& library) {
    return summary_table(library, top_offenders(out(), library, 3), 3, {});
  }
  std::string csv(const Merged& library) {
    std::string text;
    write_csv(out(), library, [&](std::string_view bytes) { text += bytes; });
    return text;
  }

  TemporaryFolder folder_;
  std::vector<std::string> warnings_;
};

TEST_F(MergeTest, RatesAsAllAtOnceButWithoutDistances) {
  auto analyses = samples(40);
  for (auto& analysis : analyses) analysis.timings[0].conditions.device.id = "one";  // what rate() insists on
  keep(analyses, 3);
  ratings::Options options;
  options.metrics.reset(index_of(Metric::kDistance));
  const ratings::SceneRating expected = ratings::rate(analyses, options);
  const Merged found = merged();
  ASSERT_EQ(found.meshes.size(), expected.meshes.size());
  EXPECT_EQ(found.density_mean, expected.density_mean);
  EXPECT_EQ(found.density_deviation, expected.density_deviation);
  EXPECT_EQ(found.drawn_triangles, expected.drawn_triangles);
  EXPECT_EQ(found.unique_triangles, expected.unique_triangles);
  for (std::size_t i = 0; i < found.meshes.size(); ++i) {
    EXPECT_EQ(found.ratings[i], expected.meshes[i].ratings) << i;
    EXPECT_EQ(found.relative_ratings[i], expected.meshes[i].relative_ratings) << i;
    EXPECT_EQ(found.aggregates[i], expected.meshes[i].aggregate) << i;
  }
}

TEST_F(MergeTest, TheTableHasTheColumnsAndDigitsOfAnalyze) {
  auto analyses = samples(5);
  for (auto& analysis : analyses) analysis.timings[0].conditions.device.id.clear();
  keep(analyses);
  report::SceneReport report;
  report.assets = analyses;
  report.options.metrics.reset(index_of(Metric::kDistance));
  report.rating = ratings::rate(analyses, report.options);
  for (auto& mesh : report.rating.meshes) mesh.distance.reset();
  EXPECT_EQ(csv(merged()), report::csv(report));
}

TEST_F(MergeTest, ShardsMakeNoDifference) {
  keep(samples(30));
  const Merged one = merged();
  const std::string one_csv = csv(one), one_json = json(one, 5);
  fs::remove_all(out());
  keep(samples(30), 7);
  EXPECT_EQ(csv(merged()), one_csv);
  EXPECT_EQ(json(merged(), 5), one_json);
}

TEST_F(MergeTest, TimesOfDevicesOfOneKindAreRatedTogether) {
  keep(samples(4));
  const Merged library = merged();
  EXPECT_FALSE(library.mixed_timings);
  EXPECT_EQ(library.timing_devices, 2U);
  EXPECT_TRUE(library.ratings[0][index_of(Metric::kRenderingTime)]);
}

TEST_F(MergeTest, TimesOfDifferentDevicesAreNotRated) {
  auto analyses = samples(4);
  analyses[2].timings[0].conditions.device.name = "another GPU";
  keep(analyses);
  const Merged library = merged();
  EXPECT_TRUE(library.mixed_timings);
  EXPECT_FALSE(library.timing);
  for (const auto& row : library.ratings) EXPECT_FALSE(row[index_of(Metric::kRenderingTime)]);
}

// A second timing of the same asset, on a device called `name`.
analysis::RenderTiming timing_on(const AssetAnalysis& asset, const std::string& name) {
  analysis::RenderTiming timing = asset.timings[0];
  timing.conditions.device = {name, "driver", "discrete", name};
  for (auto& time : timing.times) time.mean_ns = time.fastest_ns = time.slowest_ns = 7;
  return timing;
}

TEST_F(MergeTest, TheDeviceThatTimedAllCountsWhicheverComesFirst) {
  auto analyses = samples(4);
  for (auto& analysis : analyses) {
    const auto common = timing_on(analysis, "common");
    analysis.timings.insert(analysis.timings.end(), common);
  }
  analyses[3].timings.erase(analyses[3].timings.begin());
  keep(analyses);
  const Merged library = merged();
  EXPECT_FALSE(library.mixed_timings);
  ASSERT_TRUE(library.timing);
  EXPECT_EQ(library.timing->device.name, "common");
  EXPECT_EQ(library.timing_devices, 1U);
  for (const MergedMesh& mesh : library.meshes) EXPECT_EQ(mesh.time_ns, 7.0);
  for (auto& analysis : analyses)
    analysis.timings.erase(analysis.timings.begin(), analysis.timings.end() - 1);
  const std::string table = csv(library);
  fs::remove_all(out());
  keep(analyses);
  EXPECT_EQ(csv(merged()), table) << "the table has the times of that device, too";
}

TEST_F(MergeTest, TimesOfOtherStepsOrSizesAreNotThoseAskedFor) {
  auto analyses = samples(3);
  for (auto& analysis : analyses) {
    auto other = timing_on(analysis, "GPU");
    other.conditions.steps = 3;
    analysis.timings.insert(analysis.timings.begin(), other);
  }
  keep(analyses);
  const Merged library = merged();
  EXPECT_FALSE(library.mixed_timings);
  EXPECT_EQ(library.timing->steps, 8U);
  EXPECT_EQ(library.meshes[0].time_ns, 1000.0);
}

TEST_F(MergeTest, WhatWasAnalysedForFewerMetricsIsMissing) {
  keep(samples(2));
  Journal journal(out(), {});
  Record record = *journal.find("asset1001.glb");
  record.metrics.reset(index_of(Metric::kFourierTransform));
  record.finished = utc_now();
  journal.add(record);
  EXPECT_THAT(lacking(), Contains(HasSubstr("asset1001.glb.analysis' lacks metrics")));
}

TEST_F(MergeTest, WhatHasChangedSinceIsMissing) {
  keep(samples(2));
  Manifest manifest = read_manifest(out());
  manifest.assets[1].bytes = 101;
  write_manifest(out(), manifest);
  EXPECT_THAT(lacking(), Contains("asset1001.glb: has changed since it was looked at"));
}

TEST_F(MergeTest, WhatAnotherCutHasLeftDoesNotCount) {
  keep(samples(2));
  {
    Journal journal(out(), {0, 2});
    journal.add({.asset = "asset1000.glb", .reason = "asset1000.glb: gone", .bytes = 100, .finished = "9"});
  }
  EXPECT_EQ(merged().assets.size(), 2U);
}

TEST_F(MergeTest, SaysWhichShardAndWhichAssetIsMissing) {
  keep(samples(6), 2);
  fs::remove(journal_folder(out()) / "shard-00001-of-00002.jsonl");
  EXPECT_THAT(lacking(), Contains("shard 1 of 2: 3 assets are not analysed yet"));
  EXPECT_THAT(lacking(), Contains("missing: asset1001.glb"));
  const Merged part = merged({.ratings = {}, .allow_missing = true});
  EXPECT_THAT(part.missing, ElementsAre("asset1001.glb", "asset1003.glb", "asset1005.glb"));
  EXPECT_EQ(part.assets.size(), 3U);
}

TEST_F(MergeTest, AnAnalysisThatIsNotTheRecordsIsMissing) {
  keep(samples(3));
  const fs::path file = out() / "analyses" / "asset1001.glb.analysis";
  fs::remove(file);
  EXPECT_THAT(lacking(), Contains(HasSubstr("asset1001.glb.analysis' is absent")));
  std::ofstream(file) << "damaged";
  EXPECT_THAT(lacking(), Contains(HasSubstr("asset1001.glb: its analysis file")));
  fs::copy_file(out() / "analyses" / "asset1000.glb.analysis", file, fs::copy_options::overwrite_existing);
  EXPECT_THAT(lacking(), Contains(HasSubstr("is not the one that the journal names")));
}

TEST_F(MergeTest, ARecordCannotNameFilesElsewhere) {
  keep(samples(1));
  fs::rename(out() / "analyses" / "asset1000.glb.analysis", folder_.path() / "stolen.analysis");
  for (const std::string& path : {std::string("analyses/../../stolen.analysis"),
                                  (folder_.path() / "stolen.analysis").string(), std::string()}) {
    Journal journal(out(), {});
    Record record = *journal.find("asset1000.glb");
    record.analysis = path;
    record.finished = utc_now();
    journal.add(record);
    EXPECT_THAT(lacking(), Contains(HasSubstr("is not in the library's folder"))) << path;
  }
}

TEST_F(MergeTest, AnalysesMadeUnderOtherOptionsAreMissing) {
  auto analyses = samples(2);
  analyses[1].parameters.alpha_degrees = 3;
  keep(analyses);
  EXPECT_THAT(lacking(), Contains(HasSubstr("asset1001.glb.analysis' was made under other options")));
}

TEST_F(MergeTest, ShapesInSeveralAssetsAreDuplicates) {
  keep(samples(10));
  const Merged library = merged();
  ASSERT_EQ(library.duplicates.size(), 1U);
  EXPECT_EQ(library.duplicates[0].assets.size(), 10U);
  EXPECT_EQ(library.duplicates[0].redundant_triangles(), 9 * 500U);
}

TEST_F(MergeTest, TheWorstComeFirstAndCopiesOnce) {
  keep(samples(10));
  const Merged library = merged();
  const Offenders offenders = top_offenders(out(), library, 2);
  const auto& worst = offenders[index_of(Metric::kPolygonsPerPlanarGroup)];
  ASSERT_EQ(worst.size(), 2U);
  EXPECT_EQ(worst[0].mesh, 0U);
  EXPECT_EQ(worst[0].value, 0.5);
  EXPECT_EQ(worst[0].node, "node 0");
  const auto& dense = offenders[index_of(Metric::kRelativeDensity)];
  EXPECT_EQ(dense[0].others, 9U) << "the same shape in ten assets";
  EXPECT_TRUE(offenders[index_of(Metric::kDistance)].empty());
}

TEST_F(MergeTest, TheSummaryHoldsTotalsAndWhatFailed) {
  keep(samples(3));
  {
    Journal journal(out(), {});
    journal.add({.asset = "asset1002.glb",
                 .status = Status::kFailed,
                 .reason = "asset1002.glb: \xff",
                 .bytes = 100,
                 .finished = utc_now()});
  }
  const Merged library = merged();
  const auto document = nlohmann::json::parse(json(library));
  EXPECT_EQ(document["assets"]["analysed"], 2);
  EXPECT_EQ(document["assets"]["failed"], 1);
  EXPECT_EQ(document["assets"]["not_analysed"][0]["reason"], "asset1002.glb: \xef\xbf\xbd");
  EXPECT_EQ(document["meshes"]["count"], 6);
  EXPECT_EQ(document["defects"]["boundary_edges"]["meshes"], 6);
  EXPECT_TRUE(document["distributions"]["ratings"]["distance"].is_null());
  EXPECT_EQ(document["distributions"]["ratings"]["planar_group_variation"]["median"], 0.25);
  EXPECT_THAT(table(library), HasSubstr("2 assets"));
  EXPECT_THAT(table(library), HasSubstr("1 assets could not be analysed"));
}

TEST_F(MergeTest, TheSummaryKeepsToItsSchema) {
  keep(samples(4));
  std::string text = json(merged());
  EXPECT_EQ(validate(folder_.write("library.json", text)), 0);
  text.replace(text.find("\"mixed_timings\": false"), 22, "\"mixed_timings\": \"no\"");
  EXPECT_EQ(validate(folder_.write("wrong.json", text)), 1);
}

TEST_F(MergeTest, AnEmptyLibraryIsNoTrouble) {
  keep({});
  const Merged library = merged();
  EXPECT_TRUE(library.meshes.empty());
  EXPECT_THAT(table(library), HasSubstr("0 assets"));
  EXPECT_EQ(validate(folder_.write("library.json", json(library))), 0);
}

TEST(Distribution, OfKnownValues) {
  const Distribution shape = distribution_of({4, 1, 3, 2, 5});
  EXPECT_EQ(shape.count, 5U);
  EXPECT_EQ(shape.mean, 3);
  EXPECT_EQ(shape.least, 1);
  EXPECT_EQ(shape.greatest, 5);
  EXPECT_DOUBLE_EQ(shape.quantiles[0], 1.2);
  EXPECT_EQ(shape.quantiles[2], 3);
  EXPECT_DOUBLE_EQ(shape.quantiles[4], 4.8);
  EXPECT_EQ(distribution_of({7}).quantiles[1], 7);
  EXPECT_EQ(distribution_of({}).count, 0U);
}

}  // namespace
}  // namespace scene_analyzer::library
