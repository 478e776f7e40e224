#include "report/glb_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace scene_analyzer::report {
namespace {

constexpr GlbColor kGrey = {128, 128, 128};
constexpr std::uint64_t kPositionBytes = 12;
constexpr std::uint64_t kColorBytes = 8;

// As ratings::to_hex() rounds.
GlbColor to_bytes(const ratings::Rgb& color) {
  const auto byte = [](double channel) {
    // The comparison is false for NaN, which lround could not take.
    return channel > 0 ? static_cast<std::uint8_t>(std::lround(std::min(channel, 1.0) * 255))
                       : std::uint8_t{};
  };
  return {byte(color[0]), byte(color[1]), byte(color[2])};
}

template <typename T>
std::uint32_t append(std::vector<T>& list, T value) {
  list.push_back(std::move(value));
  return static_cast<std::uint32_t>(list.size() - 1);
}

class Planner {
 public:
  explicit Planner(std::span<const mesh::Scene* const> scenes) : scenes_(scenes) {}

  void add(const ratings::MeshRating& row, const std::optional<ratings::Rgb>& color) {
    const mesh::Scene& scene = *scenes_[row.asset];
    const mesh::Instance& instance = scene.instances[row.instance];
    GlbInstance& added = layout_.instances.emplace_back();
    added.left_out = scene.meshes[instance.mesh].triangle_count();
    const std::optional<Placement> placement = place(instance.world);
    if (added.left_out == 0 || !placement) return;
    const std::uint32_t geometry = geometry_of(row.asset, instance.mesh, placement->baked);
    added.left_out -= layout_.geometries[geometry].triangles;
    if (layout_.geometries[geometry].triangles > 0)
      added.mesh = mesh_of(geometry, color ? to_bytes(*color) : kGrey);
  }

  GlbLayout finish() {
    for (GlbView& view : layout_.views) {
      view.offset = layout_.bytes;
      layout_.bytes += (view.bytes + 3) / 4 * 4;
    }
    return std::move(layout_);
  }

 private:
  using MeshKey = std::pair<std::size_t, std::uint32_t>;  // asset, mesh

  std::uint32_t geometry_of(std::size_t asset, std::uint32_t mesh, const mesh::Matrix3& baked) {
    const auto [entry, is_new] = geometries_.try_emplace({asset, mesh, baked}, 0);
    if (!is_new) return entry->second;
    GlbGeometry geometry;
    geometry.mesh = &scenes_[asset]->meshes[mesh];
    geometry.baked = baked;
    measure(geometry);
    entry->second = append(layout_.geometries, geometry);
    if (geometry.triangles > 0) store(entry->second, {asset, mesh});
    return entry->second;
  }

  static void measure(GlbGeometry& geometry) {
    geometry.min.fill(std::numeric_limits<float>::max());
    geometry.max.fill(std::numeric_limits<float>::lowest());
    bool all_finite = true;
    for (std::uint64_t v = 0; v < geometry.mesh->vertex_count(); ++v) {
      const std::array<float, 3> at = position(geometry, v);
      if (!is_finite(at)) {
        all_finite = false;
        continue;
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        geometry.min[axis] = std::min(geometry.min[axis], at[axis]);
        geometry.max[axis] = std::max(geometry.max[axis], at[axis]);
      }
    }
    geometry.triangles = geometry.mesh->triangle_count();
    if (all_finite) return;
    for (std::uint64_t t = 0; t < geometry.mesh->triangle_count(); ++t)
      if (!is_kept(geometry, t)) --geometry.triangles;
  }

  // Positions of its own, and the indices of its mesh if it has all triangles.
  void store(std::uint32_t index, const MeshKey& mesh) {
    GlbGeometry& geometry = layout_.geometries[index];
    const std::uint64_t vertices = geometry.mesh->vertex_count();
    geometry.positions = add_array(GlbView::Kind::kPositions, index, vertices, kPositionBytes);
    const bool whole = geometry.triangles == geometry.mesh->triangle_count();
    if (const auto known = indices_.find(mesh); whole && known != indices_.end()) {
      geometry.indices = known->second;
      return;
    }
    geometry.indices = add_array(GlbView::Kind::kIndices, index, 3 * geometry.triangles,
                                 has_short_indices(geometry) ? sizeof(std::uint16_t) : sizeof(std::uint32_t));
    if (whole) indices_.emplace(mesh, geometry.indices);
  }

  std::uint32_t add_array(GlbView::Kind kind, std::uint32_t geometry, std::uint64_t count,
                          std::uint64_t element_bytes) {
    GlbView view;
    view.kind = kind;
    view.geometry = geometry;
    view.bytes = count * element_bytes;
    return append(layout_.accessors, {append(layout_.views, view), count});
  }

  // Meshes of one colour share a view as long as the largest needs.
  std::uint32_t colors_of(const GlbColor& color, std::uint64_t vertices) {
    const auto [view, is_new_view] = color_views_.try_emplace(color, 0);
    if (is_new_view) view->second = append(layout_.views, {.kind = GlbView::Kind::kColors, .color = color});
    GlbView& stored = layout_.views[view->second];
    stored.bytes = std::max(stored.bytes, vertices * kColorBytes);
    const auto [entry, is_new] = color_accessors_.try_emplace({view->second, vertices}, 0);
    if (is_new) entry->second = append(layout_.accessors, {view->second, vertices});
    return entry->second;
  }

  std::uint32_t mesh_of(std::uint32_t geometry, const GlbColor& color) {
    const std::uint32_t colors = colors_of(color, layout_.geometries[geometry].mesh->vertex_count());
    const auto [entry, is_new] = meshes_.try_emplace({geometry, colors}, 0);
    if (is_new) entry->second = append(layout_.meshes, {geometry, colors});
    return entry->second;
  }

  std::span<const mesh::Scene* const> scenes_;
  GlbLayout layout_;
  std::map<std::tuple<std::size_t, std::uint32_t, mesh::Matrix3>, std::uint32_t> geometries_;
  std::map<MeshKey, std::uint32_t> indices_;  // accessors
  std::map<GlbColor, std::uint32_t> color_views_;
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::uint32_t> color_accessors_;  // by view and count
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> meshes_;
};

}  // namespace

std::array<float, 3> position(const GlbGeometry& geometry, std::uint64_t vertex) {
  const float* at = &geometry.mesh->positions[3 * vertex];
  const mesh::Matrix3& m = geometry.baked;
  const double x = at[0], y = at[1], z = at[2];
  std::array<float, 3> result;
  for (std::size_t row = 0; row < 3; ++row) {
    const double sum = m[3 * row] * x + m[3 * row + 1] * y + m[3 * row + 2] * z;
    result[row] = std::abs(sum) <= std::numeric_limits<float>::max() ? static_cast<float>(sum)
                                                                     : std::numeric_limits<float>::infinity();
  }
  return result;
}

bool is_finite(const std::array<float, 3>& position) {
  return std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]);
}

bool is_kept(const GlbGeometry& geometry, std::uint64_t triangle) {
  const auto corners = geometry.mesh->indices.subspan(3 * triangle, 3);
  return std::all_of(corners.begin(), corners.end(),
                     [&](std::uint32_t vertex) { return is_finite(position(geometry, vertex)); });
}

bool has_short_indices(const GlbGeometry& geometry) {
  return geometry.mesh->vertex_count() <= 0xFFFF;  // the last index is not allowed
}

GlbLayout plan_glb(std::span<const ratings::MeshRating> instances, std::span<const mesh::Scene* const> scenes,
                   std::span<const std::optional<ratings::Rgb>> colors) {
  Planner planner(scenes);
  for (std::size_t i = 0; i < instances.size(); ++i) planner.add(instances[i], colors[i]);
  return planner.finish();
}

}  // namespace scene_analyzer::report
