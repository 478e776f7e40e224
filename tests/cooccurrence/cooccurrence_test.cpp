// Area classes and contrast on the device against the plain twin.
#include <gtest/gtest.h>

#include <cmath>

#include "cooccurrence/area_classes.h"
#include "cooccurrence/class_limit.h"
#include "cooccurrence/contrast.h"
#include "reference/stages.h"
#include "support/gpu_test.h"
#include "support/stages_on_device.h"

namespace scene_analyzer::cooccurrence {
namespace {

using test_meshes::TestMesh;

class CooccurrenceTest : public test::GpuTest {
 protected:
  void compare(const TestMesh& mesh, std::uint32_t dim = 20000) {
    SCOPED_TRACE(mesh.name + " in at most " + std::to_string(dim) + " classes");
    analysis::Parameters parameters;
    parameters.dim = dim;
    const auto twin = reference::evaluate_stages(mesh, parameters);
    if (twin.triangles.kept_count == 0) return;  // the recipe leaves the room out then
    const test::MeshOnDevice found = test::measure_up_to_adjacency(device(), mesh);
    gpu::Recorder recorder(device());
    AreaClasses classes = builder().record(recorder, found.geometry, found.geometry.results(device()));
    recorder.submit_and_wait();
    builder().limit(device(), classes, dim);
    EXPECT_EQ(classes.counts.front(), twin.classes.value.size());
    compare_attributes(twin, classes);
    const auto partial = summer().record(recorder, found.geometry, found.adjacency, classes);
    recorder.submit_and_wait();
    const double sum = found.geometry.chunks.results(device(), partial).front();
    const double count = static_cast<double>(twin.contrast.neighboured);
    // On edges with more than two triangles attributes are rounded to 2^-22, on both sides of a difference.
    const double tolerance = found.adjacency.shared.count > 0 ? std::ldexp(1, -21) : 1e-9;
    EXPECT_NEAR(count > 0 ? sum / count : 0, twin.contrast.rating, tolerance);
  }

  void compare_attributes(const reference::Evaluation& twin, const AreaClasses& classes) {
    const auto class_of = classes.class_of.download(device());
    const auto values = classes.values.download(device());
    for (std::size_t t = 0; t < class_of.size(); ++t) {
      if (!twin.triangles.kept[t]) continue;
      const double expected = twin.classes.value[twin.classes.class_of[t]];
      ASSERT_NEAR(values[class_of[t]], expected, 1e-10 * expected) << t;
    }
  }

  const AreaClassBuilder& builder() {
    static auto& kept =
        *new AreaClassBuilder(device(), test::kernels(device()).scan, test::kernels(device()).sort);
    return kept;
  }
  const ContrastSummer& summer() {
    static auto& kept = *new ContrastSummer(device(), test::kernels(device()).scan);
    return kept;
  }
};

TEST_F(CooccurrenceTest, AgreesWithTheTwinOnTheCatalogue) {
  for (const TestMesh& mesh : test::measurable_meshes()) compare(mesh);
}

TEST_F(CooccurrenceTest, ClassesAreLimited) {
  for (const std::uint32_t dim : {2U, 3U, 100U}) {
    compare(test_meshes::heightfield(30, 0.5, 1), dim);
    compare(test_meshes::indexed_soup(30, 500, 2), dim);
    compare(test_meshes::torus(30, 20), dim);
  }
}

TEST_F(CooccurrenceTest, ChainsOfNearlyEqualAreas) {
  for (const std::uint32_t size : {511U, 512U, 513U, 5000U})
    compare(test_meshes::nearly_equal_areas(size, size));
}

TEST_F(CooccurrenceTest, ManyTrianglesOnOneEdge) {
  for (const std::uint32_t pages : {3U, 64U, 5000U}) compare(test_meshes::book(pages, pages));
}

TEST_F(CooccurrenceTest, NastySizes) {
  for (const std::uint32_t size : test_meshes::nasty_sizes()) compare(test_meshes::isolated_soup(size, size));
}

TEST(LimitClasses, AgreesWithScanningAllPairs) {
  test_meshes::Random random(7);
  for (const double gap : {1e-6, 1e-3, 1.0})
    for (const std::size_t count : {2U, 40U, 500U}) {
      std::vector<double> values = {1};
      while (values.size() < count) values.push_back(values.back() * (1 + 1.3e-7 + gap * random.unit()));
      for (const std::size_t limit : {std::size_t{2}, count / 3 + 2, count}) {
        const auto starts = reference::merge_classes_naive(values, limit);
        const auto limited = limit_classes(values, limit);
        ASSERT_EQ(limited.size(), values.size());
        for (std::size_t group = 0; group < starts.size(); ++group) {
          const std::size_t end = group + 1 < starts.size() ? starts[group + 1] : values.size();
          for (std::size_t i = starts[group]; i < end; ++i) ASSERT_EQ(limited[i], limited[starts[group]]);
          if (group > 0) {
            ASSERT_LT(limited[starts[group] - 1], limited[starts[group]]);
          }
        }
      }
    }
}

TEST(LimitClasses, AMillionNearlyEqualValuesFinishAndAgreeWithTheTwin) {
  std::vector<double> values = {1};
  test_meshes::Random random(8);
  while (values.size() < 300'000) values.push_back(values.back() * (1 + 1.2e-7 * (1 + 3 * random.unit())));
  const auto starts = reference::merge_classes(values, 20'000);
  const auto limited = limit_classes(values, 20'000);
  std::size_t groups = 1;
  for (std::size_t i = 1; i < limited.size(); ++i) groups += limited[i] != limited[i - 1] ? 1 : 0;
  EXPECT_EQ(groups, starts.size());
  for (std::size_t group = 1; group < starts.size(); ++group)
    ASSERT_NE(limited[starts[group] - 1], limited[starts[group]]) << group;
}

}  // namespace
}  // namespace scene_analyzer::cooccurrence
