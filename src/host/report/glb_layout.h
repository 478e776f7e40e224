// glb_layout.h — What the binary part of an exported scene holds, and where: planned before anything is
// written, because a GLB file begins with its size and with the JSON that describes it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/scene.h"
#include "ratings/ratings.h"
#include "report/glb_placement.h"

namespace scene_analyzer::report {

// One array of positions: a mesh, as it is or with a linear part applied (Placement::baked).
struct GlbGeometry {
  const mesh::TriangleMesh* mesh = nullptr;
  mesh::Matrix3 baked = mesh::kIdentity3;
  std::array<float, 3> min{}, max{};         // of the finite vertices
  std::uint64_t triangles = 0;               // whose corners are finite
  std::uint32_t positions = 0, indices = 0;  // accessors, where there are triangles
};

// The vertex with `baked` applied, in 32-bit floats; not finite where the vertex is not or the result
// overflows.
std::array<float, 3> position(const GlbGeometry& geometry, std::uint64_t vertex);
bool is_finite(const std::array<float, 3>& position);
// All corners are finite.
bool is_kept(const GlbGeometry& geometry, std::uint64_t triangle);
bool has_short_indices(const GlbGeometry& geometry);

using GlbColor = std::array<std::uint8_t, 3>;  // sRGB

// A run of bytes of one kind, from a multiple of 4 on.
struct GlbView {
  enum class Kind : std::uint8_t { kPositions, kIndices, kColors };
  Kind kind = Kind::kPositions;
  std::uint32_t geometry = 0;  // positions and indices
  GlbColor color{};            // colours
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;  // without what fills it up to a multiple of 4
};

// The first `count` elements of a view.
struct GlbAccessor {
  std::uint32_t view = 0;
  std::uint64_t count = 0;
};

// A geometry in one colour.
struct GlbMesh {
  std::uint32_t geometry = 0;
  std::uint32_t colors = 0;  // accessor
};

struct GlbInstance {
  std::optional<std::uint32_t> mesh;  // absent where there is nothing to draw
  std::uint64_t left_out = 0;         // triangles of its mesh that are not in the file
};

struct GlbLayout {
  std::vector<GlbGeometry> geometries;
  std::vector<GlbView> views;
  std::vector<GlbAccessor> accessors;
  std::vector<GlbMesh> meshes;
  std::vector<GlbInstance> instances;  // along SceneRating::meshes
  std::uint64_t bytes = 0;
};

// `colors` run along `instances`. Reads every position that is to be written once.
GlbLayout plan_glb(std::span<const ratings::MeshRating> instances, std::span<const mesh::Scene* const> scenes,
                   std::span<const std::optional<ratings::Rgb>> colors);

}  // namespace scene_analyzer::report
