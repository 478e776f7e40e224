#include <gmock/gmock.h>

#include "analysis_file/sample.h"
#include "base/error.h"

namespace scene_analyzer::analysis_file {
namespace {

using RoundTrip = FolderTest;

TEST_F(RoundTrip, EveryFieldComesBack) {
  const auto original = full_analysis();
  store(folder / "x.analysis", original);
  const auto loaded = load(folder / "x.analysis");
  ASSERT_TRUE(std::holds_alternative<analysis::AssetAnalysis>(loaded)) << std::get<Unusable>(loaded).reason;
  expect_same(std::get<analysis::AssetAnalysis>(loaded), original);
}

TEST_F(RoundTrip, AbsentStaysAbsent) {
  analysis::AssetAnalysis original;
  original.files = {{"a", true, 1, {2, 3}}};
  original.geometries.resize(1);
  original.instances.resize(1);
  store(folder / "x.analysis", original);
  const auto loaded = load(folder / "x.analysis");
  ASSERT_TRUE(std::holds_alternative<analysis::AssetAnalysis>(loaded)) << std::get<Unusable>(loaded).reason;
  expect_same(std::get<analysis::AssetAnalysis>(loaded), original);
}

TEST_F(RoundTrip, EachMetricAloneComesBack) {
  for (std::size_t i = 0; i < analysis::kMetricCount; ++i) {
    auto original = full_analysis();
    original.computed = analysis::MetricSet().set(i);
    if (i != analysis::index_of(analysis::Metric::kRenderingTime)) original.timings.clear();
    store(folder / "x.analysis", original);
    EXPECT_EQ(std::get<analysis::AssetAnalysis>(load(folder / "x.analysis")).computed, original.computed);
  }
}

TEST_F(RoundTrip, TwoStoresGiveTheSameBytes) {
  store(folder / "a.analysis", full_analysis());
  store(folder / "b.analysis", full_analysis());
  const std::string bytes = read_text(folder / "a.analysis");
  EXPECT_EQ(bytes, read_text(folder / "b.analysis"));
  EXPECT_EQ(bytes.substr(0, 8), "SCNANLZ\n");
  EXPECT_EQ(entries(folder), 2) << "nothing but the files is left";
}

TEST_F(RoundTrip, StoringAgainReplaces) {
  auto second = full_analysis();
  store(folder / "a.analysis", second);
  second.warnings = {"changed"};
  store(folder / "a.analysis", second);
  EXPECT_EQ(std::get<analysis::AssetAnalysis>(load(folder / "a.analysis")).warnings, second.warnings);
  EXPECT_EQ(entries(folder), 1);
}

TEST_F(RoundTrip, ManySmallMeshesStaySmall) {
  auto library = full_analysis();
  replace_geometries(library, 20000);
  library.instances.clear();
  for (std::uint32_t i = 0; i < 20000; ++i)
    library.instances.push_back({i,
                                 "node " + std::to_string(i),
                                 "mesh " + std::to_string(i),
                                 1,
                                 {1, 0, 0, i * 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                 {{{0, 0, 0}, {1, 1, 1}}}});
  store(folder / "a.analysis", library);
  const auto bytes = fs::file_size(folder / "a.analysis");
  std::printf("20000 meshes: %ju bytes\n", static_cast<std::uintmax_t>(bytes));
  EXPECT_LT(bytes, 20000u * 540u);  // 110 of them for every kind of defect, which few meshes have
  expect_same(std::get<analysis::AssetAnalysis>(load(folder / "a.analysis")), library);
}

TEST_F(RoundTrip, WhatCouldNotBeReadBackIsNotWritten) {
  auto bad = full_analysis();
  bad.geometries[0].surface_area = std::numeric_limits<double>::infinity();
  try {
    store(folder / "a.analysis", bad);
    FAIL() << "stored";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("geometry 0: surface area"));
    EXPECT_THAT(error.what(), testing::HasSubstr((folder / "a.analysis").string()));
  }
  EXPECT_EQ(entries(folder), 0);
}

}  // namespace
}  // namespace scene_analyzer::analysis_file
