#include "reference/area_classes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reference/stages.h"

namespace scene_analyzer::reference {
namespace {

using Values = std::vector<double>;
using Starts = std::vector<std::uint32_t>;

AreaClasses distinct(const Values& areas) {
  return distinct_areas(areas, std::vector<std::uint8_t>(areas.size(), 1));
}

TEST(AreaClasses, AClassTakesWhatIsNearItsStart) {
  const AreaClasses classes = distinct({1 + 3e-7, 1, 1 + 1e-7, 1 + 2e-7, 7});
  EXPECT_EQ(classes.value, (Values{1, 1 + 2e-7, 7}));  // chained distances do not carry a class on
  EXPECT_EQ(classes.class_of, (Starts{1, 0, 0, 1, 2}));
  EXPECT_EQ(distinct({1e-20, 1e-20 * (1 + 1e-7), 1.1e-20}).value.size(), 2U);  // relative at any scale
}

TEST(AreaClasses, DroppedTrianglesHaveNone) {
  const AreaClasses classes = distinct_areas(Values{0, 2, 1}, std::vector<std::uint8_t>{0, 1, 1});
  EXPECT_EQ(classes.class_of, (Starts{kNone, 1, 0}));
}

TEST(MergeClasses, CheapestNeighboursFirst) {
  EXPECT_EQ(merge_classes(Values{1, 2, 4, 4.5, 9}, 4), (Starts{0, 1, 2, 4}));
  EXPECT_EQ(merge_classes(Values{1, 2, 4, 4.5, 9}, 3), (Starts{0, 2, 4}));
  EXPECT_EQ(merge_classes(Values{1, 2, 4, 4.5, 9}, 5), (Starts{0, 1, 2, 3, 4}));
  EXPECT_EQ(merge_classes(Values{1, 2, 4, 4.5, 9}, 1), (Starts{0}));
  EXPECT_EQ(merge_classes(Values{}, 2), (Starts{}));
}

TEST(MergeClasses, TiesGoToTheLowerPair) {
  EXPECT_EQ(merge_classes(Values{1, 2, 3, 4, 5, 6}, 5), (Starts{0, 2, 3, 4, 5}));
  EXPECT_EQ(merge_classes(Values{1, 2, 3, 4, 5, 6}, 3), (Starts{0, 2, 4}));
  // The first pair costs more by 1e-7 of itself: equal after rounding to 20 bits.
  EXPECT_EQ(merge_classes(Values{1, 2 + 1e-7, 5, 6}, 3), (Starts{0, 2, 3}));
}

TEST(MergeClasses, AgreesWithScanningAllPairs) {
  test_meshes::Random random(12);
  for (const double gap : {1e-3, 1.0, 1e3})  // of the float step at 1: from nearly equal to wide
    for (const std::size_t count : {2U, 3U, 17U, 64U, 400U}) {
      Values values = {1};
      while (values.size() < count)
        values.push_back(values.back() * (1 + 1.3e-7 + gap * random.unit() * 1e-6));
      for (const std::size_t dim : {std::size_t{1}, std::size_t{2}, count / 3 + 1, count - 1})
        EXPECT_EQ(merge_classes(values, dim), merge_classes_naive(values, dim))
            << count << " to " << dim << ", gap " << gap;
    }
}

TEST(MergeClasses, AgreesWithScanningAllPairsOnMeshes) {
  for (const test_meshes::TestMesh& mesh : test_meshes::small_catalogue()) {
    const Evaluation stages = evaluate_stages(mesh);
    AreaClasses classes = distinct_areas(stages.triangles.area, stages.triangles.kept);
    if (classes.value.size() > 300) classes.value.resize(300);
    for (const std::size_t dim : {2U, 10U, 100U})
      EXPECT_EQ(merge_classes(classes.value, dim), merge_classes_naive(classes.value, dim))
          << mesh.name << " to " << dim;
  }
}

TEST(AreaClasses, JoinedClassesCountWithTheMeanOfTheirValues) {
  const Values areas = {1, 2, 4, 4.5, 9, 4};
  const AreaClasses classes = area_classes(areas, std::vector<std::uint8_t>(6, 1), 3);
  EXPECT_EQ(classes.value, (Values{1.5, 4.25, 9}));  // of values, not of triangles: 4 occurs twice
  EXPECT_EQ(classes.class_of, (Starts{0, 0, 1, 1, 2, 1}));
}

// Sums of a million values that differ by 2e-7 of themselves: a cost is lost in the rounding of a double's
// prefix sum.
TEST(MergeClasses, NearlyEqualValuesInGreatNumber) {
  constexpr std::size_t kCount = 1'000'000, kDim = 500'000;
  Values values(kCount);
  for (std::size_t i = 0; i < kCount; ++i)  // pairs: near (2^-20 apart), then far (2^-19)
    values[i] = 1 + static_cast<double>(i / 2) * 0x3p-20 + static_cast<double>(i % 2) * 0x1p-20;
  const Starts starts = merge_classes(values, kDim);
  ASSERT_EQ(starts.size(), kDim);
  for (std::size_t g = 0; g < kDim; ++g) ASSERT_EQ(starts[g], 2 * g);
}

}  // namespace
}  // namespace scene_analyzer::reference
