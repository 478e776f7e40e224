// disjoint_sets.h — Union-find whose roots are the lowest members.
#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace scene_analyzer::reference {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  // The lowest member of i's set. Amortised logarithmic (path halving).
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (b < a) std::swap(a, b);
    parent_[b] = a;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace scene_analyzer::reference
