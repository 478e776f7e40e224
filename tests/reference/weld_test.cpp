#include "reference/weld.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/meshes.h"

namespace scene_analyzer::reference {
namespace {

using Indices = std::vector<std::uint32_t>;

TEST(Weld, EqualCoordinatesShareTheLowestIndex) {
  const std::vector<float> positions = {1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6, 4, 5, 7};
  EXPECT_EQ(weld(positions), (Indices{0, 1, 0, 1, 4}));
}

TEST(Weld, MinusZeroEqualsZero) {
  EXPECT_EQ(weld(std::vector<float>{0.0F, -0.0F, 1, -0.0F, 0.0F, 1}), (Indices{0, 0}));
}

TEST(Weld, NanRepresentsItselfAndInfinityEqualsItself) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(weld(std::vector<float>{nan, 0, 0, nan, 0, 0, infinity, 0, 0, infinity, 0, 0}),
            (Indices{0, 1, 2, 2}));
  EXPECT_EQ(weld(std::vector<float>{nan, 0, 0, nan, 0, 0, infinity, 0, 0, infinity, 0, 0}, 5),
            (Indices{0, 1, 2, 2}));
}

TEST(Weld, ManyNansAreNotQuadratic) {
  const std::vector<float> positions(3'000'000, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(weld(positions).back(), 999'999U);
}

TEST(Weld, ToleranceIsTransitive) {
  const std::vector<float> positions = {0, 0, 0, 5, 0, 0, 2, 0, 0, 1, 0, 0, 6.5, 0, 0};
  EXPECT_EQ(weld(positions, 1), (Indices{0, 1, 0, 0, 4}));
  EXPECT_EQ(weld(positions, 0.9), (Indices{0, 1, 2, 3, 4}));
  EXPECT_EQ(weld(positions, 3), (Indices{0, 0, 0, 0, 0}));
}

// The hash table against plain comparison of every pair.
TEST(Weld, AgreesWithComparingAllPairs) {
  for (const test_meshes::TestMesh& mesh :
       {test_meshes::lattice_soup(5, 500, 3), test_meshes::unwelded(test_meshes::geosphere(5))}) {
    const Indices found = weld(mesh.positions);
    const float* p = mesh.positions.data();
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
      std::size_t lowest = 0;
      while (p[3 * lowest] != p[3 * i] || p[3 * lowest + 1] != p[3 * i + 1] ||
             p[3 * lowest + 2] != p[3 * i + 2])
        ++lowest;
      ASSERT_EQ(found[i], lowest) << mesh.name;
    }
  }
}

}  // namespace
}  // namespace scene_analyzer::reference
