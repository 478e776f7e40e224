// The whole recipe on the device against the plain double-precision twin, mesh by mesh.
#include "pipeline/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gpu/faults.h"
#include "pipeline/compare.h"
#include "pipeline/geometry_table.h"
#include "pipeline/pending_measurement.h"
#include "reference/placement.h"
#include "support/gpu_test.h"
#include "support/scenes.h"

namespace scene_analyzer::pipeline {
namespace {

using analysis::AssetAnalysis;
using analysis::MetricSet;
using test_meshes::TestMesh;

mesh::Matrix4 placed(const mesh::Matrix3& linear, const mesh::Vector3& offset) {
  return {linear[0], linear[1], linear[2], offset[0], linear[3], linear[4], linear[5], offset[1],
          linear[6], linear[7], linear[8], offset[2], 0,         0,         0,         1};
}

mesh::Scene placed_scene(const TestMesh& mesh, const std::vector<mesh::Matrix4>& worlds) {
  mesh::Scene scene = test::scene_of({mesh});
  scene.instances.clear();
  for (const mesh::Matrix4& world : worlds)
    scene.instances.push_back({.mesh = 0, .node = "node", .world = world});
  return scene;
}

class MeasureTest : public test::GpuTest {
 protected:
  AssetAnalysis measure(const mesh::Scene& scene, const analysis::Parameters& parameters = {},
                        MetricSet metrics = MetricSet().set()) {
    AssetAnalysis analysis;
    measurer().measure({.scene = scene, .analysis = analysis, .parameters = parameters, .metrics = metrics});
    return analysis;
  }

  void compare(std::vector<TestMesh> meshes, const analysis::Parameters& parameters = {}) {
    const mesh::Scene scene = test::scene_of(std::move(meshes));
    expect_agrees_with_twin(scene, parameters, measure(scene, parameters));
  }

  Measurer& measurer() {
    static auto& kept = *new Measurer(device());
    return kept;
  }
};

TEST_F(MeasureTest, TheCatalogueInOneBatch) {
  compare(test_meshes::small_catalogue());
}

TEST_F(MeasureTest, OtherParameters) {
  analysis::Parameters parameters;
  parameters.alpha_degrees = 12;
  parameters.dim = 7;
  compare(test_meshes::small_catalogue(), parameters);
}

TEST_F(MeasureTest, WeldTolerance) {
  analysis::Parameters parameters;
  parameters.weld_tolerance = 0.05;
  compare({test_meshes::unwelded(test_meshes::geosphere(4)), test_meshes::heightfield(12, 0.3, 1),
           test_meshes::signed_zeros(), test_meshes::non_finite(2), test_meshes::prism(10, 1, 0.03, 0.4)},
          parameters);
}

TEST_F(MeasureTest, RandomSoups) {
  std::vector<TestMesh> meshes;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto triangles = static_cast<std::uint32_t>(1 + seed * seed * 3);
    meshes.push_back(test_meshes::indexed_soup(static_cast<std::uint32_t>(4 + seed * 5), triangles, seed));
    meshes.push_back(test_meshes::lattice_soup(3, triangles, seed));
  }
  compare(meshes);
}

TEST_F(MeasureTest, ShuffledMeshesRateTheSame) {
  std::vector<TestMesh> meshes = test_meshes::small_catalogue(), shuffled;
  for (const TestMesh& mesh : meshes) shuffled.push_back(test_meshes::shuffled(mesh, 11));
  const AssetAnalysis one = measure(test::scene_of(meshes)), other = measure(test::scene_of(shuffled));
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    SCOPED_TRACE(meshes[i].name);
    expect_same_measures(one.geometries[i], other.geometries[i]);
  }
}

TEST_F(MeasureTest, RerunsGiveTheSameBits) {
  const mesh::Scene scene = test::scene_of(test_meshes::small_catalogue());
  const AssetAnalysis one = measure(scene), other = measure(scene);
  for (std::size_t i = 0; i < one.geometries.size(); ++i) {
    EXPECT_EQ(one.geometries[i].surface_area, other.geometries[i].surface_area);
    EXPECT_EQ(one.geometries[i].planar_group_variation, other.geometries[i].planar_group_variation);
    EXPECT_EQ(one.geometries[i].cooccurrence_contrast, other.geometries[i].cooccurrence_contrast);
    EXPECT_EQ(one.geometries[i].defects, other.geometries[i].defects);
  }
}

TEST_F(MeasureTest, MillionTrianglesOnOneEdge) {
  compare({test_meshes::book(1'000'000, 3)});
}

// Welding leaves the vertices in use at the front of their range, so all edges want to lie in one part of the
// hash table.
TEST_F(MeasureTest, EdgesThatCrowdInTheHashTable) {
  compare(
      {test_meshes::heightfield(390, 0.5, 1), test_meshes::unwelded(test_meshes::heightfield(390, 0.5, 2))});
  compare({test_meshes::shuffled(test_meshes::unwelded(test_meshes::heightfield(520, 0.5, 3)), 4)});
}

TEST_F(MeasureTest, ANodeThatIsNowhereHasNoBounds) {
  const double c = std::cos(0.5), s = std::sin(0.5);
  const mesh::Scene scene = placed_scene(
      test_meshes::cube(), {placed({c, -s, 0, s, c, 0, 0, 0, 1}, {std::nan(""), 0, 0}), mesh::kIdentity4});
  const AssetAnalysis analysis = measure(scene);
  EXPECT_EQ(analysis.instances[0].bounds, std::nullopt);
  EXPECT_TRUE(analysis.instances[1].bounds.has_value());
}

TEST_F(MeasureTest, TwentyThousandTinyMeshes) {
  std::vector<TestMesh> meshes(20'000, test_meshes::cube());
  const AssetAnalysis analysis = measure(test::scene_of(std::move(meshes)));
  for (const auto& geometry : analysis.geometries) {
    ASSERT_EQ(geometry.triangles, 12U);
    ASSERT_EQ(geometry.planar_groups, 6U);
    ASSERT_NEAR(*geometry.polygons_per_planar_group, 6.0 / 11, 1e-12);
  }
}

TEST_F(MeasureTest, AMeshWithoutTrianglesOrWithDegenerateOnesKeepsItsRow) {
  const AssetAnalysis analysis = measure(test::scene_of({TestMesh{}, test_meshes::all_degenerate()}));
  ASSERT_EQ(analysis.instances.size(), 2U);
  for (const auto& geometry : analysis.geometries) {
    EXPECT_EQ(geometry.triangles, 0U);
    EXPECT_EQ(geometry.polygons_per_planar_group, std::nullopt);
    EXPECT_EQ(geometry.cooccurrence_contrast, std::nullopt);
  }
  EXPECT_EQ(analysis.instances[0].bounds, std::nullopt);
  EXPECT_EQ(analysis.instances[1].bounds, std::nullopt);
  EXPECT_GT(analysis.geometries[1].degenerate_triangles, 0U);
}

TEST_F(MeasureTest, OnlyWhatIsAskedForIsComputed) {
  const mesh::Scene scene = test::scene_of({test_meshes::cube()});
  const AssetAnalysis analysis = measure(scene, {}, MetricSet().set(index_of(analysis::Metric::kDistance)));
  EXPECT_EQ(analysis.geometries[0].planar_groups, std::nullopt);
  EXPECT_EQ(analysis.geometries[0].area_classes, std::nullopt);
  EXPECT_EQ(analysis.geometries[0].triangles, 12U);
  EXPECT_TRUE(analysis.instances[0].bounds.has_value());
}

// --- Placement: instances, mirrored and non-uniform nodes, far origins. ---

TEST_F(MeasureTest, SimilaritiesShareOneGeometryOthersAreTransformed) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  const mesh::Scene scene = placed_scene(
      test_meshes::torus(24, 12),
      {placed({1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}),
       placed({3 * c, -3 * s, 0, 3 * s, 3 * c, 0, 0, 0, 3}, {5, 6, 7}),
       placed({-2, 0, 0, 0, 2, 0, 0, 0, 2}, {-100, 0, 0}), placed({1, 0.5, 0, 0, 1, 0, 0, 0, 4}, {1e6, 0, 0}),
       placed({1, 0.5, 0, 0, 1, 0, 0, 0, 4}, {2e6, 0, 0}), placed({1, 0, 0, 0, 1, 0, 0, 0, 0}, {0, 0, 0})});
  const AssetAnalysis analysis = measure(scene);
  ASSERT_EQ(analysis.geometries.size(), 3U);  // similarities, the sheared one twice, the flattened one
  EXPECT_NEAR(analysis.instances[1].area_scale, 9, 1e-12);
  EXPECT_NEAR(analysis.instances[2].area_scale, 4, 1e-12);
  EXPECT_EQ(analysis.instances[3].geometry, analysis.instances[4].geometry);
  expect_agrees_with_twin(scene, {}, analysis);
}

TEST_F(MeasureTest, AThousandNodesShowOneMesh) {
  std::vector<mesh::Matrix4> worlds;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 0.01 * i;
    worlds.push_back(
        placed({std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1},
               {2.0 * i, 0, 0}));
  }
  const mesh::Scene scene = placed_scene(test_meshes::geosphere(8), worlds);
  const AssetAnalysis analysis = measure(scene);
  EXPECT_EQ(analysis.geometries.size(), 1U);
  expect_agrees_with_twin(scene, {}, analysis);
}

TEST_F(MeasureTest, WhenMemoryRunsOutMeshesGetTheDeviceForThemselves) {
  const mesh::Scene scene =
      test::scene_of({test_meshes::cube(), test_meshes::torus(12, 8), test_meshes::grid(5, 5)});
  measure(scene);  // kernels are made
  for (const std::uint32_t allocations : {0U, 5U, 20U, 30U}) {
    gpu::faults(device()).allocations_until_failure = allocations;
    expect_agrees_with_twin(scene, {}, measure(scene));
  }
}

TEST_F(MeasureTest, AMeshThatDoesNotFitIsReportedAndTheOthersAreMeasured) {
  mesh::Scene scene = test::scene_of({test_meshes::cube(), test_meshes::torus(12, 8)});
  scene.instances[1].world =
      placed({1, 0.5, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0});  // a batch of its own, the second
  measure(scene);
  gpu::faults(device()).allocations_until_failure = 3;
  const AssetAnalysis analysis = measure(scene);
  EXPECT_NE(analysis.geometries[0].not_analysed, "");
  EXPECT_EQ(analysis.geometries[0].triangles, 0U);
  EXPECT_EQ(analysis.geometries[0].planar_groups, std::nullopt);
  EXPECT_EQ(analysis.instances[0].bounds, std::nullopt);
  EXPECT_EQ(analysis.geometries[1].not_analysed, "");
  EXPECT_EQ(analysis.geometries[1].triangles, 192U);
}

// Everything that is stored, field by field the same.
void expect_same(const AssetAnalysis& found, const AssetAnalysis& expected) {
  ASSERT_EQ(found.geometries.size(), expected.geometries.size());
  for (std::size_t i = 0; i < found.geometries.size(); ++i) {
    const analysis::GeometryAnalysis &one = found.geometries[i], &other = expected.geometries[i];
    EXPECT_EQ(one.triangles, other.triangles);
    EXPECT_EQ(one.components, other.components);
    EXPECT_EQ(one.cooccurrence_contrast, other.cooccurrence_contrast);
    EXPECT_EQ(one.planar_group_variation, other.planar_group_variation);
    EXPECT_EQ(one.fourier_transform, other.fourier_transform);
    EXPECT_EQ(one.signal, other.signal);
    EXPECT_EQ(one.not_analysed, other.not_analysed);
  }
}

TEST_F(MeasureTest, OneSceneIsMeasuredWhileTheHostSearchesForAnother) {
  const std::vector<mesh::Scene> scenes = {
      test::scene_of({test_meshes::torus(40, 30), test_meshes::cube()}),
      test::scene_of({test_meshes::geosphere(12)}), test::scene_of({TestMesh{}}),
      test::scene_of({test_meshes::heightfield(30, 0.5, 2), test_meshes::four_sided_tube(3)})};
  std::vector<AssetAnalysis> found(scenes.size());
  std::vector<std::unique_ptr<PendingMeasurement>> pending;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    pending.push_back(measurer().start({.scene = scenes[i], .analysis = found[i]}));
  for (const std::size_t i : {2U, 0U, 3U, 1U}) {
    pending[i]->finish();
    EXPECT_FALSE(pending[i]->is_searching());
    expect_same(found[i], measure(scenes[i]));
  }
}

TEST_F(MeasureTest, APendingMeasurementCanBeDropped) {
  const mesh::Scene scene = test::scene_of({test_meshes::torus(300, 200)}),
                    other = test::scene_of({test_meshes::cube()});
  AssetAnalysis dropped;
  measure(other);  // kernels are made
  auto pending = measurer().start({.scene = scene, .analysis = dropped});
  measure(other);
  EXPECT_TRUE(pending->is_searching()) << "the device waited for a search of many seconds";
  pending.reset();
  EXPECT_EQ(dropped.geometries.at(0).triangles, 120000U);
  EXPECT_EQ(dropped.geometries.at(0).fourier_transform, std::nullopt);
  expect_agrees_with_twin(other, {}, measure(other));
}

TEST_F(MeasureTest, ProgressOfManyBatchesNeverFalls) {
  // Sheared instances are meshes of their own, in a batch of their own.
  std::vector<mesh::Matrix4> worlds;
  for (int i = 0; i < 4; ++i) worlds.push_back(placed({1, 0.5 * i, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}));
  const mesh::Scene scene = placed_scene(test_meshes::torus(20, 12), worlds);
  for (const std::uint32_t allocations : {3U, 25U, 60U, 100000U}) {
    double last = 0;
    const auto progress = [&](double fraction, const std::string&) {
      EXPECT_GE(fraction, last);
      last = fraction;
    };
    AssetAnalysis analysis;
    gpu::faults(device()).allocations_until_failure = allocations;
    measurer().measure({.scene = scene, .analysis = analysis, .progress = progress});
    gpu::faults(device()) = {};
    EXPECT_NEAR(last, 1, 1e-9) << allocations;
  }
}

// A signal that cannot be transformed costs its mesh that rating and nothing else.
TEST_F(MeasureTest, AMeshWithoutASpectrumKeepsItsOtherRatings) {
  const mesh::Scene scene =
      test::scene_of({test_meshes::geosphere(8), test_meshes::torus(6, 5), test_meshes::geosphere(3)});
  const AssetAnalysis expected = measure(scene);
  Measurer limited(device(), {.longest = 200});
  std::vector<std::uint32_t> with_signal;
  AssetAnalysis found;
  const auto sink = [&](std::uint32_t geometry, const analysis::SignalSpectrum& signal) {
    with_signal.push_back(geometry);
    EXPECT_EQ(signal.magnitudes.size(), signal.areas.size() / 2 + 1);
  };
  limited.measure({.scene = scene, .analysis = found, .signals = sink});
  EXPECT_EQ(with_signal, (std::vector<std::uint32_t>{1, 2}));
  ASSERT_EQ(found.geometries.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(found.geometries[i].not_analysed, "");
    EXPECT_EQ(found.geometries[i].polygons_per_planar_group,
              expected.geometries[i].polygons_per_planar_group);
    EXPECT_EQ(found.geometries[i].cooccurrence_contrast, expected.geometries[i].cooccurrence_contrast);
    EXPECT_EQ(is_beyond_a_limit(found.geometries[i]), i == 0);
  }
  EXPECT_EQ(found.geometries[0].fourier_transform, std::nullopt);
  EXPECT_EQ(found.geometries[0].signal, std::nullopt);
  EXPECT_NE(found.geometries[0].no_fourier_transform.find("1280 samples"), std::string::npos);
  EXPECT_NE(found.geometries[0].no_fourier_transform.find("at most 200"), std::string::npos);
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_EQ(found.geometries[i].fourier_transform, expected.geometries[i].fourier_transform);
    EXPECT_EQ(found.geometries[i].signal, expected.geometries[i].signal);
  }
}

TEST_F(MeasureTest, AMeshBeyondTheDeviceIsReportedWithNeedAndLimit) {
  gpu::DeviceInfo small;
  small.name = "a small device";
  small.max_storage_buffer_bytes = 1024;
  small.free_memory_bytes = std::uint64_t{1} << 30;
  const mesh::Scene scene = test::scene_of({test_meshes::geosphere(8), test_meshes::cube()});
  GeometryTable table = make_geometry_table(scene);
  const auto batches = plan_batches(scene, small, table.geometries);
  ASSERT_EQ(batches.size(), 1U);
  EXPECT_EQ(batches[0].geometries, std::vector<std::uint32_t>{1});
  EXPECT_NE(table.geometries[0].not_analysed.find("1280 triangles"), std::string::npos);
  EXPECT_NE(table.geometries[0].not_analysed.find("1024 bytes"), std::string::npos);
  EXPECT_EQ(table.geometries[1].not_analysed, "");
}

}  // namespace
}  // namespace scene_analyzer::pipeline
