// stages_on_device.h — The stages up to adjacency for one test mesh, as the later rooms' tests need them.
#pragma once

#include <utility>
#include <vector>

#include "adjacency/adjacency.h"
#include "geometry/geometry.h"
#include "gpu/device.h"
#include "primitives/radix_sort.h"
#include "primitives/scan.h"
#include "support/meshes.h"

namespace scene_analyzer::test {

// The kernels, made once per process and device.
struct Kernels {
  primitives::Scan scan;
  primitives::RadixSort sort;
  geometry::GeometryBuilder geometry;
  adjacency::AdjacencyBuilder adjacency;
  explicit Kernels(gpu::Device& device)
      : scan(device), sort(device, scan), geometry(device), adjacency(device, sort) {}
};

inline Kernels& kernels(gpu::Device& device) {
  static auto& kept = *new Kernels(device);  // as long as the shared device: never destroyed
  return kept;
}

// The catalogue without meshes that have no triangle at all: the recipe puts those in no batch.
inline std::vector<test_meshes::TestMesh> measurable_meshes() {
  std::vector<test_meshes::TestMesh> meshes = test_meshes::small_catalogue();
  std::erase_if(meshes, [](const test_meshes::TestMesh& mesh) { return mesh.indices.empty(); });
  return meshes;
}

struct MeshOnDevice {
  geometry::Geometry geometry;
  adjacency::Adjacency adjacency;
};

inline MeshOnDevice measure_up_to_adjacency(gpu::Device& device, const test_meshes::TestMesh& mesh) {
  mesh::TriangleMesh triangles;
  triangles.positions = mesh.positions;
  triangles.indices = mesh.indices;
  geometry::Batch batch;
  batch.meshes.push_back({.mesh = &triangles});
  gpu::Recorder recorder(device);
  MeshOnDevice result;
  result.geometry = kernels(device).geometry.record(recorder, batch);
  auto matching = kernels(device).adjacency.record_matching(recorder, result.geometry);
  recorder.submit_and_wait();
  result.adjacency = kernels(device).adjacency.complete(device, result.geometry, std::move(matching));
  return result;
}

}  // namespace scene_analyzer::test
