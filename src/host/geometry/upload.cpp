#include "geometry/upload.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>

#include "geometry/weld_tolerance.h"

namespace scene_analyzer::geometry {
namespace {

using interface::mesh::MeshRecord;

std::vector<MeshRecord> records_of(const Batch& batch) {
  std::vector<MeshRecord> records;
  std::uint64_t vertex = 0, triangle = 0;
  for (const BatchMesh& entry : batch.meshes) {
    if (entry.mesh->triangle_count() == 0) throw std::logic_error("a mesh without triangles in a batch");
    records.push_back({.first_vertex = static_cast<std::uint32_t>(vertex),
                       .vertex_count = static_cast<std::uint32_t>(entry.mesh->vertex_count()),
                       .first_triangle = static_cast<std::uint32_t>(triangle),
                       .triangle_count = static_cast<std::uint32_t>(entry.mesh->triangle_count()),
                       .linear = entry.linear});
    vertex += entry.mesh->vertex_count();
    triangle += entry.mesh->triangle_count();
  }
  return records;
}

// Collects values of many meshes and hands them to the device in pieces of a few megabytes.
class PieceWriter {
 public:
  PieceWriter(gpu::Device& device, const gpu::Array<std::uint32_t>& target)
      : device_(device), target_(target) {}
  ~PieceWriter() = default;
  PieceWriter(const PieceWriter&) = delete;
  PieceWriter& operator=(const PieceWriter&) = delete;

  void push(std::uint32_t word) {
    piece_.push_back(word);
    if (piece_.size() == kPieceWords) flush();
  }
  void flush() {
    target_.upload(device_, piece_, written_);
    written_ += piece_.size();
    piece_.clear();
  }

 private:
  static constexpr std::size_t kPieceWords = std::size_t{1} << 20;
  gpu::Device& device_;
  const gpu::Array<std::uint32_t>& target_;
  std::vector<std::uint32_t> piece_;
  std::uint64_t written_ = 0;
};

gpu::Array<std::uint32_t> upload_axis(gpu::Device& device, const Batch& batch, std::size_t axis,
                                      std::uint64_t count) {
  gpu::Array<std::uint32_t> target(device, std::string("position ") + "xyz"[axis], count);
  PieceWriter writer(device, target);
  for (const BatchMesh& entry : batch.meshes)
    for (std::size_t i = axis; i < entry.mesh->positions.size(); i += 3)
      writer.push(std::bit_cast<std::uint32_t>(entry.mesh->positions[i]));
  writer.flush();
  return target;
}

}  // namespace

Geometry upload(gpu::Device& device, const Batch& batch) {
  Geometry geometry;
  geometry.vertex_count = batch.vertex_count();
  geometry.triangle_count = batch.triangle_count();
  geometry.transformed = batch.transformed;
  geometry.records = records_of(batch);
  geometry.chunks = ChunkTree(device, triangle_ranges(geometry.records));
  geometry.meshes = gpu::Array<MeshRecord>(device, "mesh records", geometry.records.size());
  geometry.meshes.upload(device, geometry.records);
  geometry.position_x = upload_axis(device, batch, 0, geometry.vertex_count);
  geometry.position_y = upload_axis(device, batch, 1, geometry.vertex_count);
  geometry.position_z = upload_axis(device, batch, 2, geometry.vertex_count);
  geometry.corners = gpu::Array<std::uint32_t>(device, "triangle corners", 3 * geometry.triangle_count);
  std::uint64_t written = 0;
  for (const BatchMesh& entry : batch.meshes) {
    geometry.corners.upload(device, entry.mesh->indices, written);
    written += entry.mesh->indices.size();
  }
  geometry.mesh_of = gpu::Array<std::uint32_t>(device, "mesh of triangle", geometry.triangle_count);
  geometry.areas = gpu::Array<double>(device, "triangle areas", geometry.triangle_count);
  geometry.representative =
      gpu::Array<std::uint32_t>(device, "vertex representatives", geometry.vertex_count);
  geometry.referenced =
      gpu::Array<std::uint32_t>(device, "referenced vertices", (geometry.vertex_count + 31) / 32);
  geometry.totals =
      gpu::Array<interface::mesh::GeometryTotals>(device, "geometry totals", geometry.chunks.partial_count());
  return geometry;
}

std::vector<std::uint32_t> welds_within(const Batch& batch, double tolerance) {
  std::vector<std::uint32_t> representatives;
  representatives.reserve(batch.vertex_count());
  for (const BatchMesh& entry : batch.meshes) {
    const auto base = static_cast<std::uint32_t>(representatives.size());
    for (const std::uint32_t lowest : weld_within(entry.mesh->positions, tolerance))
      representatives.push_back(base + lowest);
  }
  return representatives;
}

}  // namespace scene_analyzer::geometry
