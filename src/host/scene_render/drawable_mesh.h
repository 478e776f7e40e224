// drawable_mesh.h — A mesh as it is drawn: small on the device, precise wherever it lies.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/scene.h"

namespace scene_analyzer::scene_render {

struct DrawableMesh {
  std::vector<float> positions;  // x, y, z per vertex, in [-1,1]: (as in the file - center) / radius
  // Per vertex the mean of the normals of the triangles around it, weighted by their areas: three numbers of
  // 10 bits, 512 is 0. The shorter, the sharper the edges there. Empty: every triangle is shaded flat.
  std::vector<std::uint32_t> normals;
  // u and v, 16 bits each: (as in the file - texture_low) / texture_range. Empty without a texture.
  std::vector<std::uint32_t> texture_positions;
  std::vector<std::uint32_t> indices;  // empty: three vertices per triangle, one after the other
  std::uint64_t triangles =
      0;  // as many as the mesh has; those of positions that are not finite have no area
  mesh::Vector3 center{}, half{};  // of the box around what is drawn
  double radius = 1;               // > 0
  std::array<double, 2> texture_low{}, texture_range{};

  // At most 56 per triangle.
  std::uint64_t bytes() const {
    return sizeof(std::uint32_t) *
           (positions.size() + normals.size() + texture_positions.size() + indices.size());
  }
};

// `textured`: with texture coordinates, where the mesh has them. Cost: linear in vertices and triangles;
// memory while it runs: about 60 bytes per vertex.
DrawableMesh make_drawable(const mesh::TriangleMesh& mesh, bool textured);

// For each triple of `words` the place of the first one that equals it. Cost: linear.
std::vector<std::uint32_t> first_of_equal(const std::vector<std::array<std::uint32_t, 3>>& triples);

}  // namespace scene_analyzer::scene_render
