// first_of_equal.cpp — An open-addressed table of places.
#include <xxhash.h>

#include <bit>
#include <limits>
#include <random>

#include "scene_render/drawable_mesh.h"

namespace scene_analyzer::scene_render {
namespace {

constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

// A file that knew the hash could make every search long; no result depends on the seed.
std::uint64_t seed() {
  static const std::uint64_t kSeed = std::random_device()();
  return kSeed;
}

}  // namespace

std::vector<std::uint32_t> first_of_equal(const std::vector<std::array<std::uint32_t, 3>>& triples) {
  std::vector<std::uint32_t> first(triples.size());
  std::vector<std::uint32_t> table(std::bit_ceil(2 * triples.size() + 1), kFree);
  const std::size_t mask = table.size() - 1;
  for (std::uint32_t i = 0; i < triples.size(); ++i) {
    std::size_t slot = XXH3_64bits_withSeed(triples[i].data(), sizeof triples[i], seed()) & mask;
    while (table[slot] != kFree && triples[table[slot]] != triples[i]) slot = (slot + 1) & mask;
    if (table[slot] == kFree) table[slot] = i;
    first[i] = table[slot];
  }
  return first;
}

}  // namespace scene_analyzer::scene_render
