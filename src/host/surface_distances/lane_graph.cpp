#include "surface_distances/lane_graph.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <numeric>

namespace scene_analyzer::surface_distances {
namespace {

// Bands as wide as a part of the sources' radius: in narrower ones improvements of different lanes arrive one
// by one, wider ones do not stay in the cache. But not narrower than some arcs.
constexpr double kBandPerRadius = 0.6;
constexpr double kLeastArcsPerBand = 8;

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

// Rows of any graph with first, target and length, moved to `place`; without masses.
template <typename Distance, typename Graph, typename Convert>
LaneGraph<Distance> moved(const Graph& graph, std::span<const std::uint32_t> place, Convert convert) {
  const auto rows = static_cast<std::uint32_t>(place.size());
  LaneGraph<Distance> result;
  result.first.resize(rows + 1);
  for (std::uint32_t i = 0; i < rows; ++i) result.first[place[i] + 1] = graph.first[i + 1] - graph.first[i];
  for (std::uint32_t row = 0; row < rows; ++row) result.first[row + 1] += result.first[row];
  result.target.resize(graph.target.size());
  result.length.resize(graph.target.size());
  for (std::uint32_t i = 0; i < rows; ++i) {
    std::uint32_t to = result.first[place[i]];
    for (std::uint32_t arc = graph.first[i]; arc < graph.first[i + 1]; ++arc, ++to) {
      result.target[to] = place[graph.target[arc]];
      result.length[to] = convert(graph.length[arc]);
    }
  }
  result.mass.resize(rows);
  return result;
}

std::vector<std::uint32_t> bands_of(const RowOrder& order, double mean_arc) {
  const std::span<const double> distances = order.distances;
  const double farthest = distances.empty() ? 0 : *std::ranges::max_element(distances);
  const double width = std::max(kBandPerRadius * order.radius, kLeastArcsPerBand * mean_arc);
  const double most =
      std::clamp(width > 0 ? farthest / width : 0, 0.0, static_cast<double>(distances.size()) / 64);
  const double bands_per_length = farthest > 0 ? most / farthest : 0;
  std::vector<std::uint32_t> rows(static_cast<std::size_t>(most) + 1, 0);
  for (const double distance : distances)
    ++rows[std::min(static_cast<std::size_t>(distance * bands_per_length), rows.size() - 1)];
  std::vector<std::uint32_t> bands(1, 0);
  std::uint32_t end = 0;
  for (const std::uint32_t count : rows) {
    end += count;
    const std::uint32_t rounded = (end + 63) / 64 * 64;
    if (rounded > bands.back()) bands.push_back(rounded);
  }
  return bands;
}

template <typename Distance>
double mean(std::span<const Distance> lengths) {
  return std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
}

Units rounded_up(double length) {
  return length < kUnreached<Units> ? static_cast<Units>(std::ceil(length)) : kUnreached<Units>;
}

}  // namespace

template <typename Distance>
LaneGraph<Distance> order_by_distance(const DualGraph& graph, const RowOrder& order, double unit,
                                      std::vector<std::uint32_t>& row_of_node) {
  row_of_node = places_by_distance(order.distances);
  LaneGraph<Distance> result = moved<Distance>(graph, row_of_node, [unit](double length) {
    if constexpr (std::same_as<Distance, Units>) return rounded_up(length / unit);
    return static_cast<Distance>(length / unit);
  });
  for (std::uint32_t node = 0; node < graph.nodes(); ++node)
    result.mass[row_of_node[node]] = node < graph.triangles ? 1 : 0;
  result.bands = bands_of(order, mean<double>(graph.length));
  return result;
}

LaneGraph<Units> order_by_distance(const LaneGraph<Units>& graph, const RowOrder& order,
                                   std::vector<std::uint32_t>& new_row) {
  new_row = places_by_distance(order.distances);
  LaneGraph<Units> result = moved<Units>(graph, new_row, [](Units length) { return length; });
  for (std::uint32_t row = 0; row < graph.rows(); ++row) result.mass[new_row[row]] = graph.mass[row];
  result.constant = graph.constant;
  result.bands = bands_of(order, mean<Units>(graph.length));
  return result;
}

template LaneGraph<double> order_by_distance(const DualGraph&, const RowOrder&, double,
                                             std::vector<std::uint32_t>&);
template LaneGraph<Units> order_by_distance(const DualGraph&, const RowOrder&, double,
                                            std::vector<std::uint32_t>&);

}  // namespace scene_analyzer::surface_distances
