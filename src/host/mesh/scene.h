// scene.h — What one asset holds after import: geometries, where they stand, what they look like. Plain data.
//
// Rows of every table are *mesh instances*: one (node, mesh) pair, listed in depth-first node order (a node's
// meshes first, then its children). Several instances may share one TriangleMesh.
//
// Arrays are spans into storage that the Scene keeps alive (shared memory filled by the import worker, or
// vectors of a test); a Scene is cheap to move and immutable once built.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace scene_analyzer::mesh {

// Row-major 4x4 for column vectors: world = M * (x, y, z, 1).
using Matrix4 = std::array<double, 16>;
// Row-major 3x3.
using Matrix3 = std::array<double, 9>;
using Vector3 = std::array<double, 3>;

inline constexpr Matrix4 kIdentity4 = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
inline constexpr Matrix3 kIdentity3 = {1, 0, 0, 0, 1, 0, 0, 0, 1};

struct TriangleMesh {
  std::string name;
  std::span<const float> positions;        // x, y, z per vertex, as in the file (local coordinates)
  std::span<const std::uint32_t> indices;  // three per triangle, each < vertex_count()
  // u, v per vertex; empty when the file has none. (0, 0) is the lower left corner of the picture and (1, 1)
  // the upper right one, whatever the format: in rows from the top, v lies (1 - v) * height pixels down.
  // Values beyond 0 and 1 are in many files.
  std::span<const float> texture_coordinates;
  std::uint32_t material = 0;            // index into Scene::materials
  std::uint64_t skipped_primitives = 0;  // points and lines, which are not counted

  std::uint64_t vertex_count() const { return positions.size() / 3; }
  std::uint64_t triangle_count() const { return indices.size() / 3; }
};

struct Instance {
  std::uint32_t mesh = 0;      // index into Scene::meshes
  std::string node;            // name of the node that holds it
  Matrix4 world = kIdentity4;  // product of the node matrices, in double
};

struct Material {
  std::string name;
  std::optional<std::array<float, 4>>
      base_color;                        // linear RGBA in [0,1]; absent for Assimp's DefaultMaterial
  std::optional<std::uint32_t> texture;  // index into Scene::textures
};

inline constexpr std::uint32_t kLongestTextureSide = 1024;  // pixels, of a decoded texture

struct Texture {
  std::string path;                       // as the file names it; empty for an unnamed embedded one
  std::span<const std::uint8_t> encoded;  // embedded file bytes (PNG, JPEG, ...), empty when external
  // Decoded, where that was asked for and possible: R, G, B, A per pixel, rows from the top, values as the
  // file stores them (mostly sRGB, not linear; alpha not multiplied in). Larger pictures were halved until no
  // side is longer than kLongestTextureSide, so these are not always the size of the file's picture. 0 x 0
  // otherwise.
  std::uint32_t width = 0, height = 0;
  std::span<const std::uint8_t> pixels;  // 4 * width * height
};

// A file that the asset is made of, the asset itself first.
struct ReferencedFile {
  std::string path;   // relative to the asset's folder
  bool found = true;  // false: the asset asks for it but it is not there
};

// What the import took.
struct ImportEffort {
  double seconds = 0;                   // wall clock, of the worker
  std::uint64_t worker_peak_bytes = 0;  // its largest resident memory
  std::uint64_t answer_bytes = 0;       // memory that holds the scene's arrays
};

struct Scene {
  std::string asset;  // path as given by the user
  std::vector<TriangleMesh> meshes;
  std::vector<Instance> instances;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<ReferencedFile> files;
  std::vector<std::string> warnings;   // one sentence each, without the asset's name
  std::string format;                  // importer's name of the format, for example "glTF2"
  std::optional<double> unit_scale;    // metres per unit where the format says so
  std::optional<std::string> up_axis;  // "+Y", "-Z", ... where the format says so
  std::shared_ptr<const void> storage;
  ImportEffort effort;
};

}  // namespace scene_analyzer::mesh
