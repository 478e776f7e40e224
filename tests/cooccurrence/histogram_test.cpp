// Co-occurrence histograms on the device against the plain twin.
#include "cooccurrence/histogram.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "reference/stages.h"
#include "support/gpu_test.h"
#include "support/stages_on_device.h"

namespace scene_analyzer::cooccurrence {
namespace {

using interface::cooccurrence::kBins;
using test_meshes::TestMesh;

// Several meshes in one batch, each with what the twin says of it.
class HistogramTest : public test::GpuTest {
 protected:
  std::vector<Histogram> build(const std::vector<TestMesh>& meshes, std::uint32_t dim = 20000,
                               const HistogramLimits& limits = {}) {
    std::vector<mesh::TriangleMesh> triangles(meshes.size());
    geometry::Batch batch;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      triangles[i].positions = meshes[i].positions;
      triangles[i].indices = meshes[i].indices;
      batch.meshes.push_back({.mesh = &triangles[i]});
    }
    test::Kernels& kernels = test::kernels(device());
    gpu::Recorder recorder(device());
    const auto geometry = kernels.geometry.record(recorder, batch);
    auto matching = kernels.adjacency.record_matching(recorder, geometry);
    recorder.submit_and_wait();
    const auto adjacency = kernels.adjacency.complete(device(), geometry, std::move(matching));
    AreaClasses classes = class_builder().record(recorder, geometry, geometry.results(device()));
    recorder.submit_and_wait();
    class_builder().limit(device(), classes, dim);
    std::vector<Histogram> found;
    HistogramBuilder(device(), kernels.scan, kernels.sort, limits)
        .build(device(), geometry, adjacency, classes, [&](std::size_t mesh, Histogram histogram) {
          EXPECT_EQ(mesh, found.size());
          found.push_back(std::move(histogram));
        });
    return found;
  }

  void compare(const std::vector<TestMesh>& meshes, std::uint32_t dim = 20000,
               const HistogramLimits& limits = {}) {
    const std::vector<Histogram> found = build(meshes, dim, limits);
    ASSERT_EQ(found.size(), meshes.size());
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      SCOPED_TRACE(meshes[i].name + " in at most " + std::to_string(dim) + " classes");
      analysis::Parameters parameters;
      parameters.dim = dim;
      expect_equal(found[i], reference::evaluate_stages(meshes[i], parameters));
    }
  }

  void expect_equal(const Histogram& found, const reference::Evaluation& twin) {
    EXPECT_EQ(found.refused, "");
    ASSERT_EQ(found.values.size(), twin.classes.value.size());
    for (std::size_t i = 0; i < found.values.size(); ++i)
      ASSERT_NEAR(found.values[i], twin.classes.value[i], 1e-10 * twin.classes.value[i]) << i;

    const auto expected = reference::count_class_pairs(twin.adjacency, twin.classes);
    ASSERT_EQ(found.pairs.size(), expected.size());
    auto pair = found.pairs.begin();
    for (const auto& [key, count] : expected) {
      ASSERT_EQ(*pair, (PairCount{key.first, key.second, count}));
      ++pair;
    }
    const auto bins = reference::count_binned_pairs(twin.adjacency, twin.classes);
    EXPECT_EQ(found.bins, std::vector<std::uint64_t>(bins.begin(), bins.end()));

    expect_symmetric(found);
    const std::uint64_t neighbours =
        std::accumulate(twin.adjacency.neighbours.begin(), twin.adjacency.neighbours.end(), std::uint64_t{0});
    EXPECT_EQ(sum_of_pairs(found), neighbours);
    EXPECT_EQ(std::accumulate(found.bins.begin(), found.bins.end(), std::uint64_t{0}), neighbours);
  }

  static void expect_symmetric(const Histogram& found) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> pairs;
    for (const PairCount& pair : found.pairs) pairs[{pair.row, pair.column}] = pair.count;
    for (const PairCount& pair : found.pairs) ASSERT_EQ((pairs[{pair.column, pair.row}]), pair.count);
    for (std::size_t row = 0; row < kBins; ++row)
      for (std::size_t column = 0; column < row; ++column)
        ASSERT_EQ(found.bins[row * kBins + column], found.bins[column * kBins + row]);
  }

  static std::uint64_t sum_of_pairs(const Histogram& found) {
    std::uint64_t sum = 0;
    for (const PairCount& pair : found.pairs) sum += pair.count;
    return sum;
  }

  const AreaClassBuilder& class_builder() {
    static auto& kept =
        *new AreaClassBuilder(device(), test::kernels(device()).scan, test::kernels(device()).sort);
    return kept;
  }
};

// Books of pages and soups: windows end within and between them.
std::vector<TestMesh> entangled_meshes() {
  std::vector<TestMesh> meshes = {test_meshes::torus(12, 8), test_meshes::all_degenerate()};
  for (const std::uint32_t pages : {3U, 17U, 200U}) {
    meshes.push_back(test_meshes::book(pages, pages));
    meshes.push_back(test_meshes::indexed_soup(9, pages * 5, pages));
    meshes.push_back(test_meshes::lattice_soup(3, pages * 4, pages));
  }
  return meshes;
}

TEST_F(HistogramTest, TheCatalogueAgreesWithTheTwinInOneBatch) {
  compare(test::measurable_meshes());
}

TEST_F(HistogramTest, MergedAreasCountAsOne) {
  for (const std::uint32_t dim : {2U, 3U, 30U}) compare(test::measurable_meshes(), dim);
}

TEST_F(HistogramTest, SmallWindowsGiveTheSame) {
  HistogramLimits limits;
  limits.window = 1000;
  limits.meshes = 3;
  compare(entangled_meshes());
  compare(entangled_meshes(), 20000, limits);
}

TEST_F(HistogramTest, NastySizes) {
  std::vector<TestMesh> meshes;
  for (const std::uint32_t size : test_meshes::nasty_sizes()) {
    meshes.push_back(test_meshes::indexed_soup(size / 3 + 4, size, size));
    meshes.push_back(test_meshes::isolated_soup(size, size));
  }
  compare(meshes);
}

TEST_F(HistogramTest, AHundredThousandPagesHaveMorePairsThan32Bits) {
  // In 500 areas at most: few distinct pairs, ten thousand million of them.
  const std::vector<TestMesh> meshes = {test_meshes::book(100'000, 5), test_meshes::geosphere(4)};
  compare(meshes, 500);
  EXPECT_GE(sum_of_pairs(build(meshes, 500).front()), 9'999'900'000U);
}

TEST_F(HistogramTest, TooManyPairsAreRefusedMeshByMesh) {
  HistogramLimits limits;
  limits.pairs_of_mesh = 10'000;
  const std::vector<TestMesh> meshes = {test_meshes::geosphere(4), test_meshes::book(200, 1),
                                        test_meshes::book(50, 2)};
  const std::vector<Histogram> unlimited = build(meshes), found = build(meshes, 20000, limits);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[1].refused,
            "too many distinct pairs on edges with more than two triangles: 40000, limit 10000");
  EXPECT_TRUE(found[1].pairs.empty());
  for (const std::size_t mesh : {0U, 2U}) {
    EXPECT_EQ(found[mesh].refused, "");
    EXPECT_FALSE(found[mesh].pairs.empty());
    EXPECT_EQ(found[mesh].pairs, unlimited[mesh].pairs);
  }
  for (std::size_t mesh = 0; mesh < 3; ++mesh) EXPECT_EQ(found[mesh].bins, unlimited[mesh].bins);
  limits.pairs_of_batch = 2'000;
  EXPECT_EQ(build(meshes, 20000, limits)[2].refused,
            "too many distinct pairs on edges with more than two triangles: 2500, limit 2000 for meshes "
            "measured together");
}

TEST_F(HistogramTest, AMillionPagesOfDifferentAreaFinish) {
  const Histogram found = build({test_meshes::book(1'000'000, 9)}, 1'000'000).front();
  EXPECT_NE(found.refused, "");
  EXPECT_EQ(std::accumulate(found.bins.begin(), found.bins.end(), std::uint64_t{0}), 999'999'000'000U);
}

TEST_F(HistogramTest, TwoRunsGiveTheSame) {
  const std::vector<Histogram> one = build(entangled_meshes()), other = build(entangled_meshes());
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].values, other[i].values);
    EXPECT_EQ(one[i].pairs, other[i].pairs);
    EXPECT_EQ(one[i].bins, other[i].bins);
  }
}

}  // namespace
}  // namespace scene_analyzer::cooccurrence
