#include "reference/weld.h"

#include <bit>

#include "reference/disjoint_sets.h"
#include "reference/geometry.h"

namespace scene_analyzer::reference {
namespace {

// Equality of floats, not of bits: -0 == 0 and NaN differs from everything.
bool same_place(const float* a, const float* b) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

std::uint64_t hash_of(const float* p) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float value = p[axis] == 0.0F ? 0.0F : p[axis];  // one bit pattern for both zeros
    hash = (hash ^ std::bit_cast<std::uint32_t>(value)) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 29;
  }
  return hash;
}

std::vector<std::uint32_t> weld_equal(std::span<const float> positions) {
  const std::size_t count = positions.size() / 3;
  std::vector<std::uint32_t> representative(count);
  // Open addressing over vertex indices; vertices arrive in ascending order, so the first of a class is its
  // lowest.
  std::vector<std::uint32_t> table(std::bit_ceil(2 * count + 1), kNone);
  const std::uint64_t mask = table.size() - 1;
  for (std::uint32_t vertex = 0; vertex < count; ++vertex) {
    const float* place = &positions[3 * std::size_t{vertex}];
    representative[vertex] = vertex;
    if (!same_place(place, place))
      continue;  // a NaN; in the table, many of them would form one endless chain
    std::uint64_t slot = hash_of(place) & mask;
    while (table[slot] != kNone && !same_place(place, &positions[3 * std::size_t{table[slot]}]))
      slot = (slot + 1) & mask;
    if (table[slot] == kNone) table[slot] = vertex;
    representative[vertex] = table[slot];
  }
  return representative;
}

double squared_distance(const float* a, const float* b) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double difference = double{a[axis]} - double{b[axis]};
    sum += difference * difference;
  }
  return sum;
}

}  // namespace

std::vector<std::uint32_t> weld(std::span<const float> positions, double tolerance) {
  std::vector<std::uint32_t> representative = weld_equal(positions);
  if (tolerance <= 0) return representative;
  const auto count = static_cast<std::uint32_t>(representative.size());
  DisjointSets sets(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (representative[i] != i) {
      sets.unite(representative[i], i);
      continue;
    }
    for (std::uint32_t j = i + 1; j < count; ++j)
      if (squared_distance(&positions[3 * std::size_t{i}], &positions[3 * std::size_t{j}]) <=
          tolerance * tolerance)
        sets.unite(i, j);
  }
  for (std::uint32_t i = 0; i < count; ++i) representative[i] = sets.find(i);
  return representative;
}

}  // namespace scene_analyzer::reference
