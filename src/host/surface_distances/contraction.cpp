#include "surface_distances/contraction.h"

#include <algorithm>
#include <limits>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define WIDEST_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WIDEST_VECTORS
#endif

namespace scene_analyzer::surface_distances {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
// Sums along different paths of the same length differ by rounding.
constexpr double kRounding = 1e-13;

struct Forest {
  std::vector<std::uint32_t> parent;  // kNone: a root
  std::vector<double> offset;         // from the parent, later from the root
};

// How much longer the way through x is than the shortest to y, over all sources.
inline double detour(const Lanes& x, double length, const Lanes& y) {
  std::array<double, kLanes> excess;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    excess[lane] = x.of[lane] + length - y.of[lane] * (1 + kRounding);
  double most = excess[0];
  for (std::size_t lane = 1; lane < kLanes; ++lane) most = excess[lane] > most ? excess[lane] : most;
  return most;
}

WIDEST_VECTORS void choose_parents(const LaneGraph& graph, std::span<const Lanes> distances,
                                   const ContractionRules& rules, std::vector<std::uint8_t>& fixed,
                                   Forest& forest) {
  std::vector<double> least(graph.rows(), std::numeric_limits<double>::infinity());
  const std::size_t centre = rules.centre_lane;
  for (std::uint32_t x = 0; x < graph.rows(); ++x) {
    for (std::uint32_t arc = graph.first[x]; arc < graph.first[x + 1]; ++arc) {
      const std::uint32_t y = graph.target[arc];
      // Parents are nearer to the centre, so that there are no cycles.
      if (fixed[y] != 0 || !(distances[x].of[centre] < distances[y].of[centre])) continue;
      const double longer = detour(distances[x], graph.length[arc], distances[y]);
      if (longer > rules.tolerance || longer >= least[y]) continue;
      least[y] = longer;
      forest.parent[y] = x;
      forest.offset[y] = graph.length[arc];
    }
  }
}

// Parents become roots and offsets those from the roots.
void flatten(Forest& forest, std::vector<std::uint8_t>& done) {
  std::vector<std::uint32_t> path;
  for (std::uint32_t start = 0; start < forest.parent.size(); ++start) {
    std::uint32_t row = start;
    for (; done[row] == 0 && forest.parent[row] != kNone; row = forest.parent[row]) path.push_back(row);
    while (!path.empty()) {
      const std::uint32_t child = path.back();
      path.pop_back();
      const std::uint32_t parent = forest.parent[child];
      const bool below_root = forest.parent[parent] == kNone;
      forest.offset[child] += below_root ? 0 : forest.offset[parent];
      forest.parent[child] = below_root ? parent : forest.parent[parent];
      done[child] = 1;
    }
  }
}

// Arcs between different trees that end at a root; what ends further up is never shorter.
template <typename Visit>
void for_each_arc(const LaneGraph& graph, const Forest& forest, const std::vector<std::uint32_t>& row_of,
                  Visit visit) {
  for (std::uint32_t x = 0; x < graph.rows(); ++x) {
    const std::uint32_t from = row_of[x];
    const double offset = forest.parent[x] == kNone ? 0 : forest.offset[x];
    for (std::uint32_t arc = graph.first[x]; arc < graph.first[x + 1]; ++arc) {
      const std::uint32_t y = graph.target[arc];
      if (forest.parent[y] != kNone || row_of[y] == from) continue;
      visit(from, row_of[y], offset + graph.length[arc]);
    }
  }
}

// Of several arcs between the same rows only the shortest stays.
void merge_parallel_arcs(LaneGraph& graph) {
  std::vector<std::uint32_t> last(graph.rows(), kNone);  // place of the arc to that row
  std::uint32_t end = 0;
  for (std::uint32_t row = 0; row < graph.rows(); ++row) {
    const std::uint32_t begin = end;
    for (std::uint32_t arc = graph.first[row]; arc < graph.first[row + 1]; ++arc) {
      const std::uint32_t target = graph.target[arc];
      const std::uint32_t known = last[target];
      if (known != kNone && known >= begin) {
        graph.length[known] = std::min(graph.length[known], graph.length[arc]);
        continue;
      }
      last[target] = end;
      graph.target[end] = target;
      graph.length[end] = graph.length[arc];
      ++end;
    }
    graph.first[row] = begin;
  }
  graph.first[graph.rows()] = end;
  graph.target.resize(end);
  graph.length.resize(end);
}

}  // namespace

Contraction contract(const LaneGraph& graph, std::span<const Lanes> distances,
                     const ContractionRules& rules) {
  std::vector<std::uint8_t> marks(graph.rows(), 0);
  for (std::uint32_t row = 0; row < graph.rows(); ++row)
    marks[row] = distances[row].of[rules.centre_lane] <= rules.kept_radius ? 1 : 0;
  for (const std::uint32_t row : rules.kept_rows) marks[row] = 1;
  Forest forest{.parent = std::vector(graph.rows(), kNone), .offset = std::vector(graph.rows(), 0.0)};
  choose_parents(graph, distances, rules, marks, forest);
  std::ranges::fill(marks, std::uint8_t{0});
  flatten(forest, marks);

  Contraction result;
  result.row.resize(graph.rows());
  for (std::uint32_t row = 0; row < graph.rows(); ++row) {
    if (forest.parent[row] != kNone) continue;
    result.row[row] = static_cast<std::uint32_t>(result.roots.size());
    result.roots.push_back(row);
  }
  LaneGraph& smaller = result.graph;
  smaller.mass.assign(result.roots.size(), 0);
  double offsets = 0;
  for (std::uint32_t row = 0; row < graph.rows(); ++row) {
    const bool root = forest.parent[row] == kNone;
    if (!root) result.row[row] = result.row[forest.parent[row]];
    smaller.mass[result.row[row]] += graph.mass[row];
    offsets += root ? 0 : graph.mass[row] * forest.offset[row];
  }
  smaller.constant = graph.constant + offsets;
  smaller.first.assign(result.roots.size() + 1, 0);
  for_each_arc(graph, forest, result.row,
               [&](std::uint32_t from, std::uint32_t, double) { ++smaller.first[from + 1]; });
  for (std::size_t row = 0; row < result.roots.size(); ++row) smaller.first[row + 1] += smaller.first[row];
  smaller.target.resize(smaller.first.back());
  smaller.length.resize(smaller.first.back());
  std::vector<std::uint32_t> next(smaller.first.begin(), smaller.first.end() - 1);
  for_each_arc(graph, forest, result.row, [&](std::uint32_t from, std::uint32_t to, double length) {
    smaller.target[next[from]] = to;
    smaller.length[next[from]++] = length;
  });
  merge_parallel_arcs(smaller);
  return result;
}

}  // namespace scene_analyzer::surface_distances
