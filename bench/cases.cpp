#include "cases.h"

#include <cstdint>

namespace scene_analyzer::bench {
namespace {

using test_meshes::TestMesh;

// Noise: all areas differ, which is the most work that area classes and co-occurrence can get.
TestMesh rough_heightfield(std::uint32_t side) {
  return test_meshes::heightfield(side, 0.5, side);
}

// Boxes of few sizes, so that together they stay below the class limit as each of them does alone: joined or
// apart, what has to be computed is the same.
std::vector<TestMesh> boxes(std::uint32_t count) {
  test_meshes::Random random(count);
  std::vector<TestMesh> all;
  for (std::uint32_t i = 0; i < count; ++i) {
    TestMesh box = test_meshes::cube();
    box.name = "box " + std::to_string(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto length = static_cast<float>(1 + random.below(16)) / 8;
      for (std::size_t v = 0; v < box.vertex_count(); ++v) box.positions[3 * v + axis] *= length;
    }
    all.push_back(std::move(box));
  }
  return all;
}

std::vector<TestMesh> one(TestMesh mesh) {
  std::vector<TestMesh> meshes;
  meshes.push_back(std::move(mesh));
  return meshes;
}

std::vector<Case> make_cases() {
  struct Size {
    const char* name;
    std::uint32_t side;       // 2 side^2 triangles
    std::uint32_t frequency;  // 20 frequency^2 triangles
    int rounds;
    bool by_kernel;
  };
  std::vector<Case> all;
  for (const Size& size : {Size{"10k", 71, 22, 15, false}, Size{"100k", 224, 71, 9, false},
                           Size{"1M", 708, 224, 5, true}, Size{"10M", 2237, 708, 2, true}}) {
    all.push_back({std::string("heightfield/") + size.name, size.rounds, size.by_kernel,
                   [=] { return one(rough_heightfield(size.side)); }});
    all.push_back({std::string("geosphere/") + size.name, size.rounds, false,
                   [=] { return one(test_meshes::geosphere(size.frequency)); }});
  }
  all.push_back({"unwelded_heightfield/10M", 2, false,
                 [] { return one(test_meshes::unwelded(rough_heightfield(2237))); }});
  constexpr std::uint32_t kBoxes = 20000;
  all.push_back({"boxes_apart/240k", 7, false, [] { return boxes(kBoxes); }});
  all.push_back(
      {"boxes_joined/240k", 7, false, [] { return one(test_meshes::spread("boxes", boxes(kBoxes), 4)); }});
  return all;
}

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> all = make_cases();
  return all;
}

}  // namespace scene_analyzer::bench
