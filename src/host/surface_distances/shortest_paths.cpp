#include "surface_distances/shortest_paths.h"

#include <algorithm>
#include <bit>
#include <queue>

namespace scene_analyzer::surface_distances {
namespace {

// A ring longer than this would cost more to walk than wide buckets cost in repeated visits.
constexpr double kMostBuckets = 1 << 15;
// Visits per arc after which the buckets are given up.
constexpr std::uint64_t kMostVisits = 8;

}  // namespace

template <typename Distance>
void BasicShortestPaths<Distance>::use(const Arcs& arcs, std::uint32_t nodes) {
  arcs_ = arcs;
  nodes_ = nodes;
  buckets_serve_ = true;
  double sum = 0, longest = 0;
  const std::uint32_t count = arcs.first[nodes];
  for (const Distance length : arcs.length.first(count)) {
    if (length == kUnreached<Distance>) continue;
    sum += length;
    longest = std::max(longest, static_cast<double>(length));
  }
  if (longest == 0) longest = 1;
  const double mean = sum > 0 ? sum / count : 1;
  const double width = std::max(mean, longest / kMostBuckets);
  buckets_per_length_ = 1 / width;
  // Entries lie at most one longest arc ahead of the bucket in work.
  const std::size_t needed = std::bit_ceil(static_cast<std::size_t>(longest * buckets_per_length_) + 3);
  if (ring_.size() < needed) ring_.resize(needed);
}

template <typename Distance>
void BasicShortestPaths<Distance>::run(std::uint32_t source, std::span<Distance> distances) {
  if (buckets_serve_) buckets_serve_ = run_buckets(source, distances);
  if (!buckets_serve_) run_heap(source, distances);
}

// False, with the ring empty again, when nodes were visited too often.
template <typename Distance>
bool BasicShortestPaths<Distance>::run_buckets(std::uint32_t source, std::span<Distance> distances) {
  std::ranges::fill(distances, kUnreached<Distance>);
  distances[source] = 0;
  const std::size_t mask = ring_.size() - 1;
  const std::uint64_t most_visits = kMostVisits * (nodes_ + arcs_.first[nodes_]);
  ring_[0].push_back({0, source});
  std::uint64_t waiting = 1, visits = 0;
  for (std::size_t current = 0; waiting > 0 && visits <= most_visits; ++current) {
    auto& bucket = ring_[current & mask];
    // The bucket may grow while it is read: arcs shorter than its width lead back into it.
    for (std::size_t i = 0; i < bucket.size() && visits <= most_visits; ++i) {
      const Entry entry = bucket[i];
      if (entry.distance > distances[entry.node]) continue;
      visits += 1 + arcs_.first[entry.node + 1] - arcs_.first[entry.node];
      for (std::uint32_t arc = arcs_.first[entry.node]; arc < arcs_.first[entry.node + 1]; ++arc) {
        const Distance distance = entry.distance + arcs_.length[arc];
        const std::uint32_t target = arcs_.target[arc];
        if (target >= nodes_ || !(distance < distances[target])) continue;
        distances[target] = distance;
        ring_[static_cast<std::size_t>(distance * buckets_per_length_) & mask].push_back({distance, target});
        ++waiting;
      }
    }
    waiting -= bucket.size();
    bucket.clear();
  }
  if (visits <= most_visits) return true;
  for (auto& bucket : ring_) bucket.clear();
  return false;
}

template <typename Distance>
void BasicShortestPaths<Distance>::run_heap(std::uint32_t source, std::span<Distance> distances) const {
  std::ranges::fill(distances, kUnreached<Distance>);
  distances[source] = 0;
  const auto later = [](const Entry& a, const Entry& b) { return a.distance > b.distance; };
  std::priority_queue<Entry, std::vector<Entry>, decltype(later)> queue(later);
  queue.push({0, source});
  while (!queue.empty()) {
    const Entry entry = queue.top();
    queue.pop();
    if (entry.distance > distances[entry.node]) continue;
    for (std::uint32_t arc = arcs_.first[entry.node]; arc < arcs_.first[entry.node + 1]; ++arc) {
      const Distance distance = entry.distance + arcs_.length[arc];
      const std::uint32_t target = arcs_.target[arc];
      if (target >= nodes_ || !(distance < distances[target])) continue;
      distances[target] = distance;
      queue.push({distance, target});
    }
  }
}

template class BasicShortestPaths<double>;
template class BasicShortestPaths<Units>;

double total_distance(const DualGraph& graph, std::span<const double> distances) {
  constexpr std::size_t kBlock = 1024;  // sums of sums keep rounding far below 1e-12
  double total = 0;
  for (std::size_t begin = 0; begin < graph.triangles; begin += kBlock) {
    const std::size_t end = std::min<std::size_t>(graph.triangles, begin + kBlock);
    double block = 0;
    for (std::size_t i = begin; i < end; ++i) block += distances[i];
    total += block;
  }
  return total;
}

}  // namespace scene_analyzer::surface_distances
