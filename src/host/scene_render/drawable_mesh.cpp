#include "scene_render/drawable_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace scene_analyzer::scene_render {
namespace {

using mesh::TriangleMesh;
using mesh::Vector3;

constexpr std::uint32_t kNoNormal = 512u | 512u << 10 | 512u << 20;
// Below this length scene_mesh.frag does not look at a normal.
constexpr double kLeastUsefulLength = 0.8;
// Per triangle; with more, three vertices of its own are the smaller way to store it.
constexpr std::uint64_t kMostIndexedBytes = 56;

Vector3 position(const TriangleMesh& mesh, std::uint32_t vertex) {
  const auto at = mesh.positions.subspan(std::size_t{3} * vertex, 3);
  return {at[0], at[1], at[2]};
}

bool is_finite(const Vector3& point) {
  return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
}

// Corners of triangles that cannot be drawn become the corner of the first triangle that can: the numbers of
// the triangles stay. Empty when none can be drawn.
std::vector<std::uint32_t> drawn_corners(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> corners(mesh.indices.begin(), mesh.indices.end());
  std::vector<std::size_t> bad;
  std::uint32_t any = std::numeric_limits<std::uint32_t>::max();
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const bool good = std::all_of(corners.begin() + static_cast<std::ptrdiff_t>(i),
                                  corners.begin() + static_cast<std::ptrdiff_t>(i) + 3,
                                  [&](std::uint32_t vertex) { return is_finite(position(mesh, vertex)); });
    if (!good)
      bad.push_back(i);
    else if (any == std::numeric_limits<std::uint32_t>::max())
      any = corners[i];
  }
  if (any == std::numeric_limits<std::uint32_t>::max()) return {};
  for (const std::size_t i : bad) corners[i] = corners[i + 1] = corners[i + 2] = any;
  return corners;
}

void find_frame(const TriangleMesh& mesh, const std::vector<std::uint32_t>& corners, DrawableMesh& drawable) {
  Vector3 low = position(mesh, corners.front()), high = low;
  for (const std::uint32_t vertex : corners) {
    const Vector3 at = position(mesh, vertex);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], at[axis]);
      high[axis] = std::max(high[axis], at[axis]);
    }
  }
  double radius = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    drawable.center[axis] = (low[axis] + high[axis]) / 2;
    drawable.half[axis] = (high[axis] - low[axis]) / 2;
    radius = std::max(radius, drawable.half[axis]);
  }
  if (radius > 0) drawable.radius = radius;
}

// Sums over the triangles around a place.
struct AroundPlace {
  Vector3 normals{};
  double areas = 0;
};

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::uint32_t pack_normal(const AroundPlace& around) {
  if (!(around.areas > 0)) return kNoNormal;
  std::uint32_t packed = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    packed |= static_cast<std::uint32_t>(512 + std::lround(511 * around.normals[axis] / around.areas))
              << (10 * axis);
  return packed;
}

std::vector<std::array<std::uint32_t, 3>> position_words(const TriangleMesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> words(mesh.vertex_count());
  for (std::uint32_t v = 0; v < words.size(); ++v)
    for (std::size_t axis = 0; axis < 3; ++axis)
      words[v][axis] =
          std::bit_cast<std::uint32_t>(mesh.positions[std::size_t{3} * v + axis] + 0.0F);  // -0 is 0
  return words;
}

// Per place, the lowest vertex of each position; others stay empty. `place_of` per vertex.
std::vector<AroundPlace> sum_normals(const TriangleMesh& mesh, const std::vector<std::uint32_t>& corners,
                                     const std::vector<std::uint32_t>& place_of, const DrawableMesh& frame) {
  std::vector<AroundPlace> around(mesh.vertex_count());
  const auto framed = [&](std::uint32_t vertex) {
    Vector3 at = position(mesh, vertex);
    for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = (at[axis] - frame.center[axis]) / frame.radius;
    return at;
  };
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const Vector3 a = framed(corners[i]), b = framed(corners[i + 1]), c = framed(corners[i + 2]);
    const Vector3 normal =
        cross({b[0] - a[0], b[1] - a[1], b[2] - a[2]}, {c[0] - a[0], c[1] - a[1], c[2] - a[2]});
    const double area = std::hypot(normal[0], normal[1], normal[2]);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      AroundPlace& place = around[place_of[corners[i + corner]]];
      for (std::size_t axis = 0; axis < 3; ++axis) place.normals[axis] += normal[axis];
      place.areas += area;
    }
  }
  return around;
}

bool is_useful(const AroundPlace& around) {
  return std::hypot(around.normals[0], around.normals[1], around.normals[2]) >
         kLeastUsefulLength * around.areas;
}

// Normals per vertex; empty when none would be looked at.
std::vector<std::uint32_t> make_normals(const std::vector<AroundPlace>& around,
                                        const std::vector<std::uint32_t>& place_of) {
  if (std::none_of(around.begin(), around.end(), is_useful)) return {};
  std::vector<std::uint32_t> normals(place_of.size());
  for (std::size_t v = 0; v < normals.size(); ++v) normals[v] = pack_normal(around[place_of[v]]);
  return normals;
}

// 16 bits of the range that the mesh uses, so that a texture repeated often is as sharp as it can be.
std::vector<std::uint32_t> pack_texture_positions(const TriangleMesh& mesh, DrawableMesh& drawable) {
  const auto& given = mesh.texture_coordinates;
  std::array<double, 2> high{};
  for (std::size_t i = 0; i < 2; ++i) {
    double low = std::numeric_limits<double>::infinity(), most = -low;
    for (std::size_t at = i; at < given.size(); at += 2) {
      if (!std::isfinite(given[at])) continue;
      low = std::min<double>(low, given[at]);
      most = std::max<double>(most, given[at]);
    }
    drawable.texture_low[i] = low <= most ? low : 0;
    high[i] = low <= most ? most : 0;
    drawable.texture_range[i] = high[i] - drawable.texture_low[i];
  }
  std::vector<std::uint32_t> packed(mesh.vertex_count());
  for (std::size_t v = 0; v < packed.size(); ++v)
    for (std::size_t i = 0; i < 2; ++i) {
      const double range = drawable.texture_range[i];
      const double along = range > 0 ? (given[2 * v + i] - drawable.texture_low[i]) / range : 0;
      if (along > 0)
        packed[v] |= static_cast<std::uint32_t>(std::lround(65535 * std::min(along, 1.0))) << (16 * i);
    }
  return packed;
}

template <typename T>
std::vector<T> picked(const std::vector<T>& from, const std::vector<std::uint32_t>& places,
                      std::size_t width) {
  std::vector<T> result;
  if (from.empty()) return result;
  result.reserve(places.size() * width);
  for (const std::uint32_t place : places)
    result.insert(result.end(), from.begin() + static_cast<std::ptrdiff_t>(place * width),
                  from.begin() + static_cast<std::ptrdiff_t>((place + 1) * width));
  return result;
}

void keep_vertices(DrawableMesh& drawable, const std::vector<std::uint32_t>& kept) {
  drawable.positions = picked(drawable.positions, kept, 3);
  drawable.normals = picked(drawable.normals, kept, 1);
  drawable.texture_positions = picked(drawable.texture_positions, kept, 1);
}

// Vertices that differ in nothing that is drawn become one. Files without shared vertices shrink to half.
void join_vertices(DrawableMesh& drawable, const std::vector<std::uint32_t>& place_of) {
  std::vector<std::array<std::uint32_t, 3>> looks(place_of.size());
  for (std::size_t v = 0; v < looks.size(); ++v)
    looks[v] = {place_of[v], drawable.texture_positions.empty() ? 0 : drawable.texture_positions[v], 0};
  const std::vector<std::uint32_t> first = first_of_equal(looks);
  std::vector<std::uint32_t> kept, new_number(first.size());
  for (std::uint32_t v = 0; v < first.size(); ++v) {
    if (first[v] == v) {
      new_number[v] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(v);
    } else {
      new_number[v] = new_number[first[v]];
    }
  }
  for (std::uint32_t& index : drawable.indices) index = new_number[index];
  keep_vertices(drawable, kept);
}

}  // namespace

DrawableMesh make_drawable(const TriangleMesh& mesh, bool textured) {
  DrawableMesh drawable;
  drawable.triangles = mesh.triangle_count();
  drawable.indices = drawn_corners(mesh);
  if (drawable.indices.empty()) {
    drawable.triangles = 0;
    return drawable;
  }
  find_frame(mesh, drawable.indices, drawable);
  const std::vector<std::uint32_t> place_of = first_of_equal(position_words(mesh));
  drawable.normals = make_normals(sum_normals(mesh, drawable.indices, place_of, drawable), place_of);
  if (textured && !mesh.texture_coordinates.empty())
    drawable.texture_positions = pack_texture_positions(mesh, drawable);
  drawable.positions.resize(mesh.positions.size());
  for (std::size_t i = 0; i < drawable.positions.size(); ++i) {
    const double framed = (mesh.positions[i] - drawable.center[i % 3]) / drawable.radius;
    // What no drawn triangle uses may lie anywhere.
    drawable.positions[i] = std::abs(framed) <= 2 ? static_cast<float>(framed) : 0;
  }
  if (drawable.bytes() > kMostIndexedBytes * drawable.triangles) join_vertices(drawable, place_of);
  if (drawable.bytes() <= kMostIndexedBytes * drawable.triangles) return drawable;
  drawable.normals = {};
  keep_vertices(drawable, std::exchange(drawable.indices, {}));
  return drawable;
}

}  // namespace scene_analyzer::scene_render
