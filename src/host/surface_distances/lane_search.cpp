#include "surface_distances/lane_search.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace scene_analyzer::surface_distances {
namespace {

// Where more than one of so many rows are near, all are treated like those.
constexpr std::uint32_t kNearParts = 2;
// Steps per row and arc after which lanes are searched one by one: by then that would have been done.
constexpr std::uint64_t kMostSteps = 10;

// What a search works on, as plain arrays.
template <typename Distance>
struct Front {
  const std::uint32_t* first;
  const std::uint32_t* target;
  const Distance* length;
  Lanes<Distance>* distances;
  std::uint64_t* waiting;
  const std::uint32_t* band_of_word;
};

// All lanes as one value, which compilers split into what the processor has; left to loops, they do not.
using Bits1024 [[gnu::vector_size(128), gnu::may_alias]] = std::uint64_t;
using Bits512 [[gnu::vector_size(64), gnu::may_alias]] = std::uint64_t;
using Bits256 [[gnu::vector_size(32)]] = std::uint64_t;
using Bits128 [[gnu::vector_size(16)]] = std::uint64_t;

template <typename Distance>
struct Vector;
template <>
struct Vector<double> {
  using Type [[gnu::vector_size(128), gnu::may_alias]] = double;
  using Bits = Bits1024;
};
template <>
struct Vector<Units> {
  using Type [[gnu::vector_size(64), gnu::may_alias]] = Units;
  using Bits = Bits512;
};

template <typename Whole, typename Half>
inline void fold(const Whole& bits, Half& half) {
  std::array<Half, 2> halves;
  std::memcpy(halves.data(), &bits, sizeof(Whole));
  half = halves[0] | halves[1];
}
inline bool any(const Bits512& bits) {
  Bits256 half;
  Bits128 quarter;
  fold(bits, half);
  fold(half, quarter);
  return (quarter[0] | quarter[1]) != 0;
}
inline bool any(const Bits1024& bits) {
  Bits512 half;
  fold(bits, half);
  return any(half);
}

// target = min(target, source + length) in every lane; whether that changed anything.
template <typename Distance>
inline bool relax(const Lanes<Distance>& source, Distance length, Lanes<Distance>& target) {
  using Type = typename Vector<Distance>::Type;
  using Bits = typename Vector<Distance>::Bits;
  Type& known = reinterpret_cast<Type&>(target);
  const Type through = reinterpret_cast<const Type&>(source) + length;
  const Type lower = through < known ? through : known;
  if (!any(reinterpret_cast<const Bits&>(lower) ^ reinterpret_cast<const Bits&>(known))) return false;
  known = lower;
  return true;
}

// Looks at all waiting rows of [begin, end), in words of 64, once. Returns the steps made; `lowest` falls to
// the lowest band that has to be looked at again.
template <typename Distance>
inline std::uint64_t sweep(const Front<Distance>& front, std::size_t begin, std::size_t end,
                           std::size_t& lowest) {
  std::uint64_t steps = 0;
  for (std::size_t word = begin; word < end; ++word) {
    while (front.waiting[word] != 0) {
      const auto row = static_cast<std::uint32_t>(64 * word) +
                       static_cast<std::uint32_t>(std::countr_zero(front.waiting[word]));
      front.waiting[word] &= front.waiting[word] - 1;
      steps += 1 + front.first[row + 1] - front.first[row];
      for (std::uint32_t arc = front.first[row]; arc < front.first[row + 1]; ++arc) {
        const std::uint32_t target = front.target[arc];
        if (!relax(front.distances[row], front.length[arc], front.distances[target])) continue;
        front.waiting[target / 64] |= std::uint64_t{1} << target % 64;
        lowest = std::min<std::size_t>(lowest, front.band_of_word[target / 64]);
      }
    }
  }
  return steps;
}

// Sweeps over a band until none of its rows waits, then goes on with the next; improvements that lead back to
// a band before it wait until the sweep is over, so that those of many lanes are spread together. False after
// too many steps, with rows still waiting.
template <typename Distance>
inline bool spread_bands(const Front<Distance>& front, std::span<const std::uint32_t> bands,
                         std::uint64_t most_steps) {
  std::uint64_t steps = 0;
  for (std::size_t band = 0; band + 1 < bands.size();) {
    std::size_t lowest = band + 1;
    steps += sweep(front, bands[band] / 64, bands[band + 1] / 64, lowest);
    if (steps > most_steps) return false;
    band = lowest;
  }
  return true;
}

// Compilers cannot clone templates for processors, hence two functions, and the same below.
WIDEST_VECTORS bool spread(const Front<double>& front, std::span<const std::uint32_t> bands,
                           std::uint64_t most_steps) {
  return spread_bands(front, bands, most_steps);
}
WIDEST_VECTORS bool spread(const Front<Units>& front, std::span<const std::uint32_t> bands,
                           std::uint64_t most_steps) {
  return spread_bands(front, bands, most_steps);
}

struct TotalsAndMost {
  std::array<double, kLanes> totals{};
  std::array<double, kLanes> most{};  // largest distance
};

template <typename Distance>
inline TotalsAndMost add_up_rows(const LaneGraph<Distance>& graph, const Lanes<Distance>* distances) {
  constexpr std::uint32_t kBlock = 1024;  // sums of sums, for precision
  std::array<SumOf<Distance>, kLanes> totals{};
  std::array<Distance, kLanes> most{};
  for (std::uint32_t begin = 0; begin < graph.rows(); begin += kBlock) {
    const std::uint32_t end = std::min(graph.rows(), begin + kBlock);
    std::array<SumOf<Distance>, kLanes> block{};
    for (std::uint32_t row = begin; row < end; ++row) {
      const SumOf<Distance> mass = graph.mass[row];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const Distance distance = distances[row].of[lane];
        block[lane] += mass * distance;
        most[lane] = most[lane] < distance ? distance : most[lane];
      }
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) totals[lane] += block[lane];
  }
  TotalsAndMost result;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    result.totals[lane] = static_cast<double>(totals[lane] + graph.constant);
    result.most[lane] = most[lane];
  }
  return result;
}

WIDEST_VECTORS TotalsAndMost add_up(const LaneGraph<double>& graph, const Lanes<double>* distances) {
  return add_up_rows(graph, distances);
}
WIDEST_VECTORS TotalsAndMost add_up(const LaneGraph<Units>& graph, const Lanes<Units>* distances) {
  return add_up_rows(graph, distances);
}

}  // namespace

template <typename Distance>
void LaneSearch<Distance>::run(const LaneGraph<Distance>& graph, std::span<const std::uint32_t> sources,
                               std::uint32_t near) {
  if (!try_together(graph, sources, near)) search_apart(graph, sources, graph.rows());
}

template <typename Distance>
bool LaneSearch<Distance>::try_together(const LaneGraph<Distance>& graph,
                                        std::span<const std::uint32_t> sources, std::uint32_t near) {
  distances_.resize(graph.rows());
  if (near > graph.rows() / kNearParts) return false;
  Lanes<Distance> unreached;
  unreached.of.fill(kUnreached<Distance>);
  std::ranges::fill(distances_, unreached);
  waiting_.assign((graph.rows() + 63) / 64, 0);
  band_of_word_.resize(waiting_.size());
  for (std::uint32_t band = 0; band + 1 < graph.bands.size(); ++band)
    std::fill(band_of_word_.begin() + graph.bands[band] / 64,
              band_of_word_.begin() + graph.bands[band + 1] / 64, band);
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
  return spread({graph.first.data(), graph.target.data(), graph.length.data(), distances_.data(),
                 waiting_.data(), band_of_word_.data()},
                graph.bands, kMostSteps * (graph.rows() + graph.target.size()));
}

// On the part of the graph that rows [0, rows) make.
template <typename Distance>
void LaneSearch<Distance>::search_apart(const LaneGraph<Distance>& graph,
                                        std::span<const std::uint32_t> sources, std::uint32_t rows) {
  paths_.use({graph.first, graph.target, graph.length}, rows);
  row_distances_.resize(rows);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (lane < sources.size()) paths_.run(sources[lane], row_distances_);
    for (std::uint32_t row = 0; row < rows; ++row)
      distances_[row].of[lane] = lane < sources.size() ? row_distances_[row] : distances_[row].of[0];
  }
}

template <typename Distance>
std::array<double, kLanes> LaneSearch<Distance>::totals(const LaneGraph<Distance>& graph) const {
  TotalsAndMost sums = add_up(graph, distances_.data());
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    if (sums.most[lane] >= kUnreached<Distance>) sums.totals[lane] = std::numeric_limits<double>::infinity();
  return sums.totals;
}

template class LaneSearch<double>;
template class LaneSearch<Units>;

}  // namespace scene_analyzer::surface_distances
