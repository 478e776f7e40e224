// framing.h — How a mesh stands before the eye while it is timed: its bounding sphere fills the view.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/scene.h"

namespace scene_analyzer::render_timing {

// A mesh to be timed; the spans must stay alive until it was. At least one triangle is drawn.
struct TimedMesh {
  std::span<const float> positions;              // x, y, z per vertex
  std::span<const std::uint32_t> indices;        // three per triangle
  std::span<const std::uint32_t> left_out = {};  // triangles that are not drawn, ascending
  mesh::Matrix3 linear = mesh::kIdentity3;       // applied to positions
};

// What is drawn of a mesh: positions in the unit sphere around the middle of the drawn triangles' bounds,
// where the farthest of their corners touches it.
struct FramedMesh {
  std::vector<float> positions;  // as many as the mesh has; 0 where no drawn triangle uses them
  std::vector<std::uint32_t> indices;
};
FramedMesh frame(const TimedMesh& mesh);

// Rotation `index` of steps x steps: 2 pi i / steps about x, then 2 pi j / steps about y, with
// index = i steps + j. Row-major.
std::array<float, 9> rotation(std::uint32_t index, std::uint32_t steps);

// `count` different ones of `all` rotations, which is at least 1 and at most `all`: spread over both axes.
std::vector<std::uint32_t> spread_rotations(std::uint32_t count, std::uint32_t all);

}  // namespace scene_analyzer::render_timing
