#include "reference/cooccurrence.h"

#include <gtest/gtest.h>

#include <numeric>

#include "reference/stages.h"

namespace scene_analyzer::reference {
namespace {

// The rule word by word: every pair of every edge.
double contrast_of_all_pairs(const Evaluation& stages) {
  const auto value = [&](std::uint32_t half_edge) -> long double {
    return stages.classes.value[stages.classes.class_of[half_edge / 3]];
  };
  std::vector<long double> sum(stages.triangles.kept.size());
  for (std::size_t e = 0; e < stages.adjacency.edge_count(); ++e)
    for (const std::uint32_t i : stages.adjacency.edge(e))
      for (const std::uint32_t j : stages.adjacency.edge(e))
        if (i != j) sum[i / 3] += (value(i) - value(j)) * (value(i) - value(j));
  long double total = 0;
  std::uint64_t neighboured = 0;
  for (std::size_t t = 0; t < sum.size(); ++t)
    if (stages.adjacency.neighbours[t] > 0) {
      total += sum[t] / stages.adjacency.neighbours[t];
      ++neighboured;
    }
  if (neighboured == 0) return 0;
  const long double range = stages.classes.value.back() - stages.classes.value.front();
  if (range <= 1e-5L * stages.classes.value.back()) return 0;
  return static_cast<double>(total / (neighboured * range * range));
}

TEST(Cooccurrence, AgreesWithAllPairs) {
  for (const test_meshes::TestMesh& mesh : test_meshes::small_catalogue())
    for (const std::uint32_t dim : {2U, 30U, 20000U}) {
      const Evaluation stages = evaluate_stages(mesh, {.dim = dim});
      EXPECT_LE(stages.classes.value.size(), dim) << mesh.name;
      EXPECT_NEAR(stages.contrast.rating, contrast_of_all_pairs(stages), 1e-12)
          << mesh.name << " dim " << dim;
      EXPECT_LE(stages.contrast.rating, 1 + 1e-12) << mesh.name;
    }
}

TEST(Cooccurrence, HistogramsCountOrderedPairsOfNeighbours) {
  for (const test_meshes::TestMesh& mesh : test_meshes::small_catalogue()) {
    const Evaluation stages = evaluate_stages(mesh, {.dim = 200});
    const std::uint64_t expected = std::accumulate(stages.adjacency.neighbours.begin(),
                                                   stages.adjacency.neighbours.end(), std::uint64_t{0});
    std::uint64_t exact = 0;
    const ClassPairs pairs = count_class_pairs(stages.adjacency, stages.classes);
    for (const auto& [key, count] : pairs) {
      exact += count;
      ASSERT_EQ(count, pairs.at({key.second, key.first})) << mesh.name;
    }
    EXPECT_EQ(exact, expected) << mesh.name;
    const BinnedPairs bins = count_binned_pairs(stages.adjacency, stages.classes);
    EXPECT_EQ(std::accumulate(bins.begin(), bins.end(), std::uint64_t{0}), expected) << mesh.name;
  }
}

TEST(Cooccurrence, HistogramOfTheTube) {
  const Evaluation tube = evaluate_stages(test_meshes::four_sided_tube(2));
  EXPECT_EQ(count_class_pairs(tube.adjacency, tube.classes), (ClassPairs{{{0, 1}, 16}, {{1, 0}, 16}}));
  const BinnedPairs bins = count_binned_pairs(tube.adjacency, tube.classes);
  EXPECT_EQ(bins[63], 16U);
  EXPECT_EQ(bins[std::size_t{63} * kBins], 16U);
  const Evaluation flat = evaluate_stages(test_meshes::grid(4, 4));
  EXPECT_EQ(count_binned_pairs(flat.adjacency, flat.classes)[0], 80U);  // 40 inner edges
}

}  // namespace
}  // namespace scene_analyzer::reference
