#include "surface_distances/contraction.h"

#include <algorithm>

#include "interface/mesh.h"

namespace scene_analyzer::surface_distances {
namespace {

using interface::mesh::kNone;

struct Forest {
  std::vector<std::uint32_t> root;  // per row: itself where it is one
  std::vector<Units> offset;        // distance from the root
  bool is_root(std::uint32_t row) const { return root[row] == row; }
};

// How much longer the way through x is than the shortest to y, over all sources.
inline Units detour(const Lanes<Units>& x, Units length, const Lanes<Units>& y) {
  Units most = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const Units longer = x.of[lane] + length - y.of[lane];
    most = most < longer ? longer : most;
  }
  return most;
}

// Rows join the tree of a row before them, so that there are no cycles.
WIDEST_VECTORS void grow(const LaneGraph<Units>& graph, const Lanes<Units>* distances, Units tolerance,
                         const std::uint8_t* kept, Units* least, Forest& forest) {
  for (std::uint32_t x = 0; x < graph.rows(); ++x) {
    const std::uint32_t root = forest.root[x];
    for (std::uint32_t arc = graph.first[x]; arc < graph.first[x + 1]; ++arc) {
      const std::uint32_t y = graph.target[arc];
      if (y <= x || kept[y] != 0 || least[y] == 0) continue;
      const Units offset = forest.offset[x] + graph.length[arc];
      if (offset >= kUnreached<Units>) continue;
      const Units longer = detour(distances[root], offset, distances[y]);
      // No longer than the way from the root: then the root is nearer to all sources than what it stands for,
      // and no shortest path to a root leads through its own tree.
      if (longer > std::min(tolerance, offset) || longer >= least[y]) continue;
      least[y] = longer;
      forest.root[y] = root;
      forest.offset[y] = offset;
    }
  }
}

Forest grow_forest(const LaneGraph<Units>& graph, std::span<const Lanes<Units>> distances,
                   std::span<const std::uint32_t> kept_rows, Units tolerance) {
  Forest forest{.root = {}, .offset = std::vector<Units>(graph.rows(), 0)};
  for (std::uint32_t row = 0; row < graph.rows(); ++row) forest.root.push_back(row);
  std::vector<std::uint8_t> kept(graph.rows(), 0);
  for (const std::uint32_t row : kept_rows) kept[row] = 1;
  std::vector<Units> least(graph.rows(), kUnreached<Units>);
  grow(graph, distances.data(), tolerance, kept.data(), least.data(), forest);
  return forest;
}

// Numbers the roots and adds up what they stand for.
void gather_rows(const LaneGraph<Units>& graph, const Forest& forest, Contraction& result) {
  result.row.resize(graph.rows());
  result.graph.constant = graph.constant;
  for (std::uint32_t row = 0; row < graph.rows(); ++row) {
    if (forest.is_root(row)) {
      result.row[row] = static_cast<std::uint32_t>(result.roots.size());
      result.roots.push_back(row);
      result.graph.mass.push_back(graph.mass[row]);
      continue;
    }
    result.row[row] = result.row[forest.root[row]];
    result.graph.mass[result.row[row]] += graph.mass[row];
    result.graph.constant += std::uint64_t{graph.mass[row]} * forest.offset[row];
  }
}

// Arcs between different trees that end at a root; what ends further up is never shorter.
template <typename Visit>
void for_each_arc(const LaneGraph<Units>& graph, const Forest& forest, const std::vector<std::uint32_t>& row,
                  Visit visit) {
  for (std::uint32_t x = 0; x < graph.rows(); ++x) {
    for (std::uint32_t arc = graph.first[x]; arc < graph.first[x + 1]; ++arc) {
      const std::uint32_t y = graph.target[arc];
      if (!forest.is_root(y) || row[y] == row[x]) continue;
      visit(row[x], row[y], std::min(forest.offset[x] + graph.length[arc], kUnreached<Units>));
    }
  }
}

void gather_arcs(const LaneGraph<Units>& graph, const Forest& forest, Contraction& result) {
  LaneGraph<Units>& smaller = result.graph;
  smaller.first.assign(smaller.rows() + 1, 0);
  for_each_arc(graph, forest, result.row,
               [&](std::uint32_t from, std::uint32_t, Units) { ++smaller.first[from + 1]; });
  for (std::size_t row = 0; row < smaller.rows(); ++row) smaller.first[row + 1] += smaller.first[row];
  smaller.target.resize(smaller.first.back());
  smaller.length.resize(smaller.first.back());
  std::vector<std::uint32_t> next(smaller.first.begin(), smaller.first.end() - 1);
  for_each_arc(graph, forest, result.row, [&](std::uint32_t from, std::uint32_t to, Units length) {
    smaller.target[next[from]] = to;
    smaller.length[next[from]++] = length;
  });
}

// Of several arcs between the same rows only the shortest stays.
void merge_parallel_arcs(LaneGraph<Units>& graph) {
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

Contraction contract(const LaneGraph<Units>& graph, std::span<const Lanes<Units>> distances,
                     std::span<const std::uint32_t> kept, Units tolerance) {
  const Forest forest = grow_forest(graph, distances, kept, tolerance);
  Contraction result;
  gather_rows(graph, forest, result);
  gather_arcs(graph, forest, result);
  merge_parallel_arcs(result.graph);
  return result;
}

}  // namespace scene_analyzer::surface_distances
