// surfaces.h — A test mesh as the twin sees it, and the same through the device.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "reference/stages.h"
#include "reference/surface_distances.h"
#include "support/gpu_test.h"
#include "support/stages_on_device.h"
#include "surface_distances/arcs.h"
#include "surface_distances/dual_graph.h"

namespace scene_analyzer::surface_distances {

struct TwinSurface {
  reference::Evaluation stages;
  reference::SurfaceArcs arcs;
  explicit TwinSurface(const test_meshes::TestMesh& mesh)
      : stages(reference::evaluate_stages(mesh)),
        arcs(reference::surface_arcs(reference::geometry_of(mesh, stages), stages.triangles,
                                     stages.adjacency)) {}
};

inline void connect(reference::SurfaceArcs& arcs, std::uint32_t a, std::uint32_t b, double length) {
  arcs.from[a].push_back({b, length});
  arcs.from[b].push_back({a, length});
}

// Nodes in the order of `arcs`, all of them triangles.
inline DualGraph graph_of(const reference::SurfaceArcs& arcs) {
  DualGraph graph{
      .triangles = static_cast<std::uint32_t>(arcs.from.size()), .first = {0}, .target = {}, .length = {}};
  for (const auto& from : arcs.from) {
    for (const auto& arc : from) {
      graph.target.push_back(arc.target);
      graph.length.push_back(arc.length);
    }
    graph.first.push_back(static_cast<std::uint32_t>(graph.target.size()));
  }
  return graph;
}
// Nodes in the order of the file; for meshes of one component.
inline DualGraph graph_of(const TwinSurface& twin) {
  return graph_of(twin.arcs);
}

inline std::vector<std::uint32_t> numbers_up_to(std::uint32_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

class SurfaceTest : public test::GpuTest {
 protected:
  struct Measured {
    mesh::TriangleMesh source;
    BatchSurfaces surfaces;
    MeshSurface surface() const { return surfaces.surface(0, source); }
  };
  static const ArcMeasurer& measurer() {
    static auto& kept = *new ArcMeasurer(device());
    return kept;
  }
  // A view of `mesh`, which must stay alive.
  static Measured measure(const test_meshes::TestMesh& mesh) {
    Measured result;
    result.source.positions = mesh.positions;
    result.source.indices = mesh.indices;
    const test::MeshOnDevice on_device = test::measure_up_to_adjacency(device(), mesh);
    result.surfaces = measurer().measure(device(), on_device.geometry, on_device.adjacency);
    return result;
  }
};

}  // namespace scene_analyzer::surface_distances
