#include "surface_distances/lane_search.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

// The widest vectors that the processor has, chosen when the program starts. Results do not depend on it:
// there are only sums and comparisons, lane by lane.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define WIDEST_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WIDEST_VECTORS
#endif

namespace scene_analyzer::surface_distances {
namespace {

// Where more than one of so many rows are near, all are treated like those.
constexpr std::uint32_t kNearParts = 4;
// Steps per row and arc after which lanes are searched one by one: by then that would have been done.
constexpr std::uint64_t kMostSteps = 5;

// target = min(target, source + length) in every lane; whether that changed anything.
inline bool relax(const Lanes& source, double length, Lanes& target) {
  Lanes lower;
  long long changed = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const double through = source.of[lane] + length;
    const double before = target.of[lane];
    changed |= through < before ? 1 : 0;
    lower.of[lane] = through < before ? through : before;
  }
  if (changed != 0) target = lower;
  return changed != 0;
}

// Always goes on at the lowest waiting row: an improvement behind is spread before anything ahead is built on
// it. False after too many steps, with rows still waiting.
WIDEST_VECTORS bool spread(const LaneGraph& graph, Lanes* distances, std::uint64_t* waiting,
                           std::size_t words, std::uint64_t most_steps) {
  std::uint64_t steps = 0;
  for (std::size_t word = 0; word < words;) {
    if (waiting[word] == 0) {
      ++word;
      continue;
    }
    if (steps > most_steps) return false;
    const auto row =
        static_cast<std::uint32_t>(64 * word) + static_cast<std::uint32_t>(std::countr_zero(waiting[word]));
    waiting[word] &= waiting[word] - 1;
    steps += 1 + graph.first[row + 1] - graph.first[row];
    for (std::uint32_t arc = graph.first[row]; arc < graph.first[row + 1]; ++arc) {
      const std::uint32_t target = graph.target[arc];
      if (!relax(distances[row], graph.length[arc], distances[target])) continue;
      waiting[target / 64] |= std::uint64_t{1} << target % 64;
      word = std::min<std::size_t>(word, target / 64);
    }
  }
  return true;
}

WIDEST_VECTORS void add_up(const LaneGraph& graph, const Lanes* distances,
                           std::array<double, kLanes>& totals) {
  constexpr std::uint32_t kBlock = 1024;  // sums of sums, for precision
  totals.fill(graph.constant);
  for (std::uint32_t begin = 0; begin < graph.rows(); begin += kBlock) {
    const std::uint32_t end = std::min(graph.rows(), begin + kBlock);
    std::array<double, kLanes> block{};
    for (std::uint32_t row = begin; row < end; ++row)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        block[lane] += graph.mass[row] * distances[row].of[lane];
    for (std::size_t lane = 0; lane < kLanes; ++lane) totals[lane] += block[lane];
  }
}

// Places by distance: sorted into as many equally wide classes as there are places, in the old order within a
// class.
std::vector<std::uint32_t> places_by_distance(std::span<const double> distances) {
  const auto count = static_cast<std::uint32_t>(distances.size());
  const double farthest = count == 0 ? 0 : *std::ranges::max_element(distances);
  const double classes_per_length = farthest > 0 ? (count - 1) / farthest : 0;
  const auto class_of = [&](double distance) {
    return static_cast<std::uint32_t>(distance * classes_per_length);
  };
  std::vector<std::uint32_t> begin(count + 2, 0), place(count);
  for (const double distance : distances) ++begin[class_of(distance) + 2];
  for (std::uint32_t i = 2; i < count + 2; ++i) begin[i] += begin[i - 1];
  for (std::uint32_t i = 0; i < count; ++i) place[i] = begin[class_of(distances[i]) + 1]++;
  return place;
}

// Rows of any graph with first, target and length, moved to `place`.
template <typename Graph>
LaneGraph moved(const Graph& graph, std::span<const std::uint32_t> place) {
  const auto rows = static_cast<std::uint32_t>(place.size());
  LaneGraph result;
  result.first.resize(rows + 1);
  for (std::uint32_t i = 0; i < rows; ++i) result.first[place[i] + 1] = graph.first[i + 1] - graph.first[i];
  for (std::uint32_t row = 0; row < rows; ++row) result.first[row + 1] += result.first[row];
  result.target.resize(graph.target.size());
  result.length.resize(graph.target.size());
  for (std::uint32_t i = 0; i < rows; ++i) {
    std::uint32_t to = result.first[place[i]];
    for (std::uint32_t arc = graph.first[i]; arc < graph.first[i + 1]; ++arc, ++to) {
      result.target[to] = place[graph.target[arc]];
      result.length[to] = graph.length[arc];
    }
  }
  result.mass.resize(rows);
  return result;
}

}  // namespace

LaneGraph order_by_distance(const DualGraph& graph, std::span<const double> distances,
                            std::vector<std::uint32_t>& row_of_node) {
  row_of_node = places_by_distance(distances);
  LaneGraph result = moved(graph, row_of_node);
  for (std::uint32_t node = 0; node < graph.nodes(); ++node)
    result.mass[row_of_node[node]] = node < graph.triangles ? 1 : 0;
  return result;
}

LaneGraph order_by_distance(const LaneGraph& graph, std::span<const double> distances,
                            std::vector<std::uint32_t>& new_row) {
  new_row = places_by_distance(distances);
  LaneGraph result = moved(graph, new_row);
  for (std::uint32_t row = 0; row < graph.rows(); ++row) result.mass[new_row[row]] = graph.mass[row];
  result.constant = graph.constant;
  return result;
}

void LaneSearch::run(const LaneGraph& graph, std::span<const std::uint32_t> sources, std::uint32_t near) {
  distances_.resize(graph.rows());
  if (near <= graph.rows() / kNearParts && search_together(graph, sources, near)) return;
  search_apart(graph, sources, graph.rows());
}

// False where the order of rows serves the lanes so badly that searches one by one are cheaper.
bool LaneSearch::search_together(const LaneGraph& graph, std::span<const std::uint32_t> sources,
                                 std::uint32_t near) {
  Lanes unreached;
  unreached.of.fill(std::numeric_limits<double>::infinity());
  std::ranges::fill(distances_, unreached);
  waiting_.assign((graph.rows() + 63) / 64, 0);
  const auto wait = [&](std::uint32_t row) { waiting_[row / 64] |= std::uint64_t{1} << row % 64; };
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::uint32_t row = sources[lane < sources.size() ? lane : 0];
    distances_[row].of[lane] = 0;
    wait(row);
  }
  if (std::ranges::all_of(sources, [&](std::uint32_t row) { return row < near; })) {
    search_apart(graph, sources, near);
    for (std::uint32_t row = 0; row < near; ++row) wait(row);
  }
  return spread(graph, distances_.data(), waiting_.data(), waiting_.size(),
                kMostSteps * (graph.rows() + graph.target.size()));
}

// On the part of the graph that rows [0, rows) make.
void LaneSearch::search_apart(const LaneGraph& graph, std::span<const std::uint32_t> sources,
                              std::uint32_t rows) {
  paths_.use({graph.first, graph.target, graph.length}, rows);
  row_distances_.resize(rows);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (lane < sources.size()) paths_.run(sources[lane], row_distances_);
    for (std::uint32_t row = 0; row < rows; ++row)
      distances_[row].of[lane] = lane < sources.size() ? row_distances_[row] : distances_[row].of[0];
  }
}

std::array<double, kLanes> LaneSearch::totals(const LaneGraph& graph) const {
  std::array<double, kLanes> totals{};
  add_up(graph, distances_.data(), totals);
  return totals;
}

}  // namespace scene_analyzer::surface_distances
