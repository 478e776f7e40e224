#include "report/glb_arrays.h"

#include <bit>
#include <cmath>

namespace scene_analyzer::report {
namespace {

template <typename T>
void append_number(std::string& out, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) out += static_cast<char>((value >> (8 * i)) & 0xFF);
}

// A vertex that is not finite is in no triangle: it is put where it widens no bounds.
void append_positions(std::string& out, const GlbGeometry& geometry) {
  for (std::uint64_t v = 0; v < geometry.mesh->vertex_count(); ++v) {
    const std::array<float, 3> at = position(geometry, v);
    for (const float coordinate : is_finite(at) ? at : geometry.min)
      append_number(out, std::bit_cast<std::uint32_t>(coordinate));
  }
}

void append_indices(std::string& out, const GlbGeometry& geometry) {
  const bool all = geometry.triangles == geometry.mesh->triangle_count();
  const bool is_short = has_short_indices(geometry);
  for (std::uint64_t t = 0; t < geometry.mesh->triangle_count(); ++t) {
    if (!all && !is_kept(geometry, t)) continue;
    for (const std::uint32_t vertex : geometry.mesh->indices.subspan(3 * t, 3)) {
      if (is_short)
        append_number(out, static_cast<std::uint16_t>(vertex));
      else
        append_number(out, vertex);
    }
  }
}

void append_colors(std::string& out, const GlbView& view) {
  std::string element;
  for (const std::uint8_t channel : view.color) append_number(element, to_linear(channel));
  append_number(element, std::uint16_t{0xFFFF});
  for (std::uint64_t i = 0; i < view.bytes; i += element.size()) out += element;
}

}  // namespace

void append_word(std::string& out, std::uint32_t value) {
  append_number(out, value);
}

std::uint16_t to_linear(std::uint8_t srgb) {
  const double value = srgb / 255.0;
  const double linear = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  return static_cast<std::uint16_t>(std::lround(linear * 0xFFFF));
}

void append_arrays(std::string& out, const GlbLayout& layout) {
  for (const GlbView& view : layout.views) {
    switch (view.kind) {
      case GlbView::Kind::kPositions:
        append_positions(out, layout.geometries[view.geometry]);
        break;
      case GlbView::Kind::kIndices:
        append_indices(out, layout.geometries[view.geometry]);
        break;
      case GlbView::Kind::kColors:
        append_colors(out, view);
        break;
    }
    out.append((view.bytes + 3) / 4 * 4 - view.bytes, '\0');
  }
}

}  // namespace scene_analyzer::report
