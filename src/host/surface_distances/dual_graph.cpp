#include "surface_distances/dual_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "interface/adjacency.h"

namespace scene_analyzer::surface_distances {
namespace {

using interface::adjacency::kShared;
using interface::mesh::kNone;

// Spreads the lowest 21 bits so that two others fit between each.
std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1FFFFF;
  x = (x | x << 32) & 0x001F00000000FFFF;
  x = (x | x << 16) & 0x001F0000FF0000FF;
  x = (x | x << 8) & 0x100F00F00F00F00F;
  x = (x | x << 4) & 0x10C30C30C30C30C3;
  return (x | x << 2) & 0x1249249249249249;
}

class SurfaceReader {
 public:
  explicit SurfaceReader(const MeshSurface& surface) : surface_(surface) {}

  std::uint32_t count() const { return static_cast<std::uint32_t>(surface_.areas.size()); }
  std::uint32_t twin(std::uint32_t half_edge) const { return surface_.twins[half_edge]; }
  double half_arc(std::uint32_t half_edge) const { return surface_.half_arcs[half_edge]; }
  std::uint32_t local(std::uint32_t half_edge_of_batch) const {
    return half_edge_of_batch - 3 * surface_.first_triangle;
  }
  static bool is_shared(std::uint32_t twin) { return twin != kNone && (twin & kShared) != 0; }
  std::span<const std::uint32_t> edge(std::uint32_t twin) const {
    const std::uint32_t begin = twin & ~kShared;
    return surface_.shared.subspan(begin, surface_.shared_ends[begin] - begin);
  }
  bool has_neighbour(std::uint32_t triangle) const {
    for (std::uint32_t h = 3 * triangle; h < 3 * triangle + 3; ++h)
      if (twin(h) != kNone) return true;
    return false;
  }

  // Triangles with neighbours along a Morton curve through their first corners.
  std::vector<std::uint32_t> in_space_order() const {
    std::array<float, 3> low, high;
    low.fill(std::numeric_limits<float>::max());
    high.fill(std::numeric_limits<float>::lowest());
    std::vector<std::uint32_t> order;
    for (std::uint32_t t = 0; t < count(); ++t) {
      if (!has_neighbour(t)) continue;
      order.push_back(t);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], place(t, axis));
        high[axis] = std::max(high[axis], place(t, axis));
      }
    }
    double extent = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      extent = std::max(extent, double{high[axis]} - double{low[axis]});
    const double scale = extent > 0 ? 0x1FFFFF / extent : 0;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
    keys.reserve(order.size());
    for (const std::uint32_t t : order) {
      std::uint64_t key = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        key |= spread_bits(static_cast<std::uint64_t>((double{place(t, axis)} - double{low[axis]}) * scale))
               << axis;
      keys.emplace_back(key, t);
    }
    std::ranges::sort(keys);
    for (std::size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].second;
    return order;
  }

  // Calls visit(triangle) for what shares an edge with `triangle`; may repeat. An edge with more than two
  // triangles is visited when `first_visit(edge)` says so.
  template <typename FirstVisit, typename Visit>
  void for_each_neighbour(std::uint32_t triangle, FirstVisit first_visit, Visit visit) const {
    for (std::uint32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
      const std::uint32_t other = twin(h);
      if (other == kNone) continue;
      if (!is_shared(other))
        visit(local(other) / 3);
      else if (first_visit(other & ~kShared))
        for (const std::uint32_t member : edge(other)) visit(local(member) / 3);
    }
  }

 private:
  float place(std::uint32_t triangle, std::size_t axis) const {
    return surface_.positions[3 * std::size_t{surface_.indices[3 * std::size_t{triangle}]} + axis];
  }

  const MeshSurface& surface_;
};

// Numbers for the mesh's edges with more than two triangles, which lie together in the batch's list.
class EdgeNumbers {
 public:
  explicit EdgeNumbers(const SurfaceReader& reader) {
    std::uint32_t low = kNone, high = 0;
    for (std::uint32_t h = 0; h < 3 * reader.count(); ++h) {
      if (!SurfaceReader::is_shared(reader.twin(h))) continue;
      low = std::min(low, reader.twin(h) & ~kShared);
      high = std::max(high, reader.twin(h) & ~kShared);
    }
    if (low == kNone) return;
    low_ = low;
    numbers_.assign(high - low + 1, kNone);
  }
  std::uint32_t& operator[](std::uint32_t begin) { return numbers_[begin - low_]; }

 private:
  std::uint32_t low_ = 0;
  std::vector<std::uint32_t> numbers_;
};

// Per triangle its component, numbered in the order of first triangles; kNone without neighbours.
std::uint32_t number_components(const SurfaceReader& reader, std::span<const std::uint32_t> order,
                                std::vector<std::uint32_t>& component) {
  EdgeNumbers visited(reader);
  const auto first_visit = [&](std::uint32_t edge) { return std::exchange(visited[edge], 0) == kNone; };
  std::uint32_t components = 0;
  std::vector<std::uint32_t> stack;
  for (const std::uint32_t start : order) {
    if (component[start] != kNone) continue;
    component[start] = components;
    stack.push_back(start);
    while (!stack.empty()) {
      const std::uint32_t triangle = stack.back();
      stack.pop_back();
      reader.for_each_neighbour(triangle, first_visit, [&](std::uint32_t neighbour) {
        if (component[neighbour] != kNone) return;
        component[neighbour] = components;
        stack.push_back(neighbour);
      });
    }
    ++components;
  }
  return components;
}

// Arcs of one component. `node_of`: per triangle of the mesh; `edges`: kNone for those not met yet.
void connect(const SurfaceReader& reader, std::span<const std::uint32_t> node_of, EdgeNumbers& edges,
             Component& component) {
  DualGraph& graph = component.graph;
  graph.triangles = static_cast<std::uint32_t>(component.triangles.size());
  graph.first.push_back(0);
  std::vector<std::uint32_t> met;  // shared edges, as twins
  for (const std::uint32_t triangle : component.triangles) {
    for (std::uint32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
      const std::uint32_t other = reader.twin(h);
      if (other == kNone) continue;
      if (!SurfaceReader::is_shared(other)) {
        graph.target.push_back(node_of[reader.local(other) / 3]);
        graph.length.push_back(reader.half_arc(h) + reader.half_arc(reader.local(other)));
        continue;
      }
      std::uint32_t& edge = edges[other & ~kShared];
      if (edge == kNone) {
        edge = graph.triangles + static_cast<std::uint32_t>(met.size());
        met.push_back(other);
      }
      graph.target.push_back(edge);
      graph.length.push_back(reader.half_arc(h));
    }
    graph.first.push_back(static_cast<std::uint32_t>(graph.target.size()));
  }
  for (const std::uint32_t twin : met) {
    for (const std::uint32_t member : reader.edge(twin)) {
      graph.target.push_back(node_of[reader.local(member) / 3]);
      graph.length.push_back(reader.half_arc(reader.local(member)));
    }
    graph.first.push_back(static_cast<std::uint32_t>(graph.target.size()));
  }
}

}  // namespace

std::vector<Component> connected_components(const MeshSurface& surface) {
  const SurfaceReader reader(surface);
  const std::vector<std::uint32_t> order = reader.in_space_order();
  std::vector<std::uint32_t> component_of(reader.count(), kNone), node_of(reader.count(), kNone);
  std::vector<Component> components(number_components(reader, order, component_of));
  for (const std::uint32_t triangle : order) {
    auto& triangles = components[component_of[triangle]].triangles;
    node_of[triangle] = static_cast<std::uint32_t>(triangles.size());
    triangles.push_back(triangle);
  }
  EdgeNumbers edges(reader);
  for (Component& component : components) connect(reader, node_of, edges, component);
  return components;
}

}  // namespace scene_analyzer::surface_distances
