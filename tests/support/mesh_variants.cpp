#include <algorithm>
#include <numeric>
#include <sstream>

#include "support/meshes.h"

namespace scene_analyzer::test_meshes {
namespace {

std::vector<std::uint32_t> permutation(std::size_t count, Random& random) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

}  // namespace

TestMesh unwelded(const TestMesh& mesh) {
  TestMesh result{mesh.name + ", unwelded", {}, {}};
  for (const std::uint32_t index : mesh.indices) {
    result.indices.push_back(static_cast<std::uint32_t>(result.vertex_count()));
    const float* p = &mesh.positions[3 * std::size_t{index}];
    result.positions.insert(result.positions.end(), {p[0], p[1], p[2]});
  }
  return result;
}

TestMesh shuffled(const TestMesh& mesh, std::uint64_t seed) {
  TestMesh result = mesh;
  result.name += ", shuffled";
  Random random(seed);
  const std::vector<std::uint32_t> new_vertex = permutation(mesh.vertex_count(), random);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    std::copy_n(&mesh.positions[3 * v], 3, &result.positions[3 * std::size_t{new_vertex[v]}]);
  const std::vector<std::uint32_t> new_triangle = permutation(mesh.triangle_count(), random);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      result.indices[3 * std::size_t{new_triangle[t]} + c] = new_vertex[mesh.indices[3 * t + c]];
  return result;
}

TestMesh flipped(const TestMesh& mesh, std::uint64_t seed) {
  TestMesh result = mesh;
  result.name += ", flipped";
  Random random(seed);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (random.below(2) == 0) std::swap(result.indices[3 * t + 1], result.indices[3 * t + 2]);
  return result;
}

TestMesh moved(const TestMesh& mesh, double x, double y, double z) {
  TestMesh result = mesh;
  result.name += ", moved";
  const double offset[] = {x, y, z};
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    result.positions[i] = static_cast<float>(mesh.positions[i] + offset[i % 3]);
  return result;
}

TestMesh scaled(const TestMesh& mesh, double factor) {
  TestMesh result = mesh;
  std::ostringstream name;
  name << mesh.name << ", scaled " << factor;
  result.name = name.str();
  for (float& coordinate : result.positions) coordinate = static_cast<float>(coordinate * factor);
  return result;
}

TestMesh doubled_faces(const TestMesh& mesh) {
  TestMesh result = mesh;
  result.name += ", faces doubled";
  result.indices.insert(result.indices.end(), mesh.indices.begin(), mesh.indices.end());
  return result;
}

TestMesh joined(const std::string& name, const std::vector<TestMesh>& parts) {
  TestMesh result{name, {}, {}};
  for (const TestMesh& part : parts) {
    const auto base = static_cast<std::uint32_t>(result.vertex_count());
    result.positions.insert(result.positions.end(), part.positions.begin(), part.positions.end());
    for (const std::uint32_t index : part.indices) result.indices.push_back(base + index);
  }
  return result;
}

TestMesh spread(const std::string& name, const std::vector<TestMesh>& parts, double distance) {
  std::vector<TestMesh> placed;
  for (const TestMesh& part : parts)
    placed.push_back(moved(part, distance * static_cast<double>(placed.size()), 0, 0));
  return joined(name, placed);
}

}  // namespace scene_analyzer::test_meshes
