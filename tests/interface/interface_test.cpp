// Structs that shaders and C++ share have one layout: in buffers, member by member, and as parameter blocks,
// by the SPIR-V's offsets.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "gpu/recorder.h"
#include "gpu/reflection.h"
#include "hash_half_edges.spv.h"
#include "interface/adjacency.h"
#include "interface/cooccurrence.h"
#include "interface/defects.h"
#include "interface/geometry.h"
#include "interface/mesh.h"
#include "interface/planar_groups.h"
#include "interface/primitives.h"
#include "interface/spectrum.h"
#include "join_coplanar.spv.h"
#include "locate_shared.spv.h"
#include "make_area_keys.spv.h"
#include "modulate_signals.spv.h"
#include "number_members.spv.h"
#include "scatter_digits.spv.h"
#include "support/gpu_test.h"
#include "total_magnitudes.spv.h"

namespace scene_analyzer {
namespace {

class InterfaceTest : public test::GpuTest {};

// Elements 0 and 1 number their members from 1 and from 101.
template <typename T, typename Check>
void check_both(gpu::Device& device, const gpu::Array<T>& array, Check check) {
  const std::vector<T> elements = array.download(device);
  check(elements[0], 0);
  check(elements[1], 100);
}

TEST_F(InterfaceTest, BuffersHoldTheSameStructsOnBothSides) {
  gpu::Array<interface::mesh::MeshRecord> records(device(), "records", 2);
  gpu::Array<interface::mesh::Chunk> chunks(device(), "chunks", 2);
  gpu::Array<interface::mesh::GeometryTotals> geometry(device(), "geometry", 2);
  gpu::Array<interface::geometry::InstanceRecord> instances(device(), "instances", 2);
  gpu::Array<interface::adjacency::TopologyTotals> topology(device(), "topology", 2);
  gpu::Array<interface::planar_groups::PlanarTotals> planar(device(), "planar", 2);
  gpu::Array<interface::cooccurrence::SortedRange> ranges(device(), "ranges", 2);
  gpu::Array<interface::cooccurrence::ClassRange> classes(device(), "classes", 2);
  gpu::Array<interface::spectrum::SpectrumPart> parts(device(), "parts", 2);
  gpu::Array<interface::spectrum::ShortSignal> short_signals(device(), "short signals", 2);
  gpu::Array<interface::spectrum::ChirpSignal> chirp_signals(device(), "chirp signals", 2);
  gpu::Array<interface::spectrum::Segment> segments(device(), "segments", 2);
  gpu::Array<interface::defects::TriangleDefects> triangle_defects(device(), "triangle defects", 2);
  gpu::Array<interface::defects::TriangleMasks> triangle_masks(device(), "triangle masks", 2);
  gpu::Array<interface::defects::VertexDefects> vertex_defects(device(), "vertex defects", 2);
  gpu::Array<interface::defects::VertexMasks> vertex_masks(device(), "vertex masks", 2);
  const gpu::Kernel kernel = device().make_kernel("number_members", number_members_spv);
  gpu::Recorder recorder(device());
  recorder.run(kernel, 1, gpu::NoParams{},
               {records, chunks, geometry, instances, topology, planar, ranges, classes, parts, short_signals,
                chirp_signals, segments, triangle_defects, triangle_masks, vertex_defects, vertex_masks});
  recorder.submit_and_wait();

  check_both(device(), records, [](const auto& e, unsigned n) {
    EXPECT_EQ((std::array{e.first_vertex, e.vertex_count, e.first_triangle, e.triangle_count}),
              (std::array{n + 1, n + 2, n + 3, n + 4}));
    for (unsigned k = 0; k < 9; ++k) EXPECT_EQ(e.linear[k], n + 5 + k);
  });
  check_both(device(), chunks, [](const auto& e, unsigned n) {
    EXPECT_EQ((std::array{e.first, e.count, e.mesh}), (std::array{n + 1, n + 2, n + 3}));
  });
  check_both(device(), geometry, [](const auto& e, unsigned n) {
    EXPECT_EQ((std::array{e.area, e.smallest_area, e.largest_area, e.largest_coordinate}),
              (std::array{n + 1.0, n + 2.0, n + 3.0, n + 4.0}));
    EXPECT_EQ((std::array{e.kept, e.degenerate}), (std::array{n + 5, n + 6}));
    for (unsigned k = 0; k < 3; ++k) EXPECT_EQ(e.low[k], static_cast<float>(n + 7 + k));
    for (unsigned k = 0; k < 3; ++k) EXPECT_EQ(e.high[k], static_cast<float>(n + 10 + k));
  });
  check_both(device(), instances, [](const auto& e, unsigned n) {
    for (unsigned k = 0; k < 12; ++k) EXPECT_EQ(e.world[k], n + 1 + k);
    EXPECT_EQ((std::array{e.first_block, e.block_count, e.first_output}),
              (std::array{n + 13, n + 14, n + 15}));
  });
  check_both(device(), topology, [](const auto& e, unsigned n) {
    EXPECT_EQ((std::array{e.components, e.isolated, e.boundary_edges, e.non_manifold_edges}),
              (std::array{n + 1, n + 2, n + 3, n + 4}));
  });
  check_both(device(), planar, [](const auto& e, unsigned n) {
    EXPECT_EQ(e.squared_sizes, n + 1.0);
    EXPECT_EQ((std::array{e.groups, e.largest}), (std::array{n + 2, n + 3}));
  });
  check_both(device(), ranges, [](const auto& e, unsigned n) {
    EXPECT_EQ((std::array{e.first, e.count, e.first_block}), (std::array{n + 1, n + 2, n + 3}));
  });
  check_both(device(), classes, [](const auto& e, unsigned n) {
    EXPECT_EQ((std::array{e.lowest, e.highest}), (std::array{n + 1.0, n + 2.0}));
    EXPECT_EQ((std::array{e.first, e.count}), (std::array{n + 3, n + 4}));
  });
  check_both(device(), parts, [](const auto& e, unsigned n) {
    EXPECT_EQ((std::array{e.zero, e.largest, e.sum, e.weighted_sum}),
              (std::array{n + 1.0, n + 2.0, n + 3.0, n + 4.0}));
  });
  check_both(device(), short_signals, [](const auto& e, unsigned n) {
    EXPECT_EQ((std::array{e.first_sample, e.size, e.first_root, e.first_magnitude}),
              (std::array{n + 1, n + 2, n + 3, n + 4}));
  });
  check_both(device(), chirp_signals, [](const auto& e, unsigned n) {
    EXPECT_EQ(e.inverse_period, n + 1.0);
    EXPECT_EQ((std::array{e.first_sample, e.size, e.first_phase, e.fine_bits, e.chirp, e.first_magnitude}),
              (std::array{n + 2, n + 3, n + 4, n + 5, n + 6, n + 7}));
  });
  check_both(device(), segments, [](const auto& e, unsigned n) {
    EXPECT_EQ((std::array{e.signal, e.first, e.count}), (std::array{n + 1, n + 2, n + 3}));
  });
  const auto count_on = [](const auto& numbers, unsigned first) {
    for (unsigned k = 0; k < numbers.size(); ++k) EXPECT_EQ(numbers[k], first + k);
  };
  check_both(device(), triangle_defects, [&](const auto& e, unsigned n) { count_on(e.counts, n + 1); });
  check_both(device(), triangle_masks, [&](const auto& e, unsigned n) { count_on(e.words, n + 1); });
  check_both(device(), vertex_defects, [&](const auto& e, unsigned n) {
    count_on(e.counts, n + 1);
    count_on(e.low, n + 4);
    count_on(e.high, n + 7);
  });
  check_both(device(), vertex_masks, [&](const auto& e, unsigned n) { count_on(e.words, n + 1); });
}

struct Member {
  const char* name;
  std::size_t offset, size;
};

void expect_block(std::span<const std::uint32_t> words, std::size_t size,
                  const std::vector<Member>& members) {
  const gpu::Reflection shader = gpu::reflect(words);
  EXPECT_EQ(shader.push_constant_bytes, size);
  EXPECT_LE(size, 128U);
  ASSERT_EQ(shader.push_constants.size(), members.size());
  for (std::size_t i = 0; i < members.size(); ++i) {
    EXPECT_EQ(shader.push_constants[i].name, members[i].name);
    EXPECT_EQ(shader.push_constants[i].offset_bytes, members[i].offset);
    EXPECT_EQ(shader.push_constants[i].size_bytes, members[i].size);
  }
}
#define MEMBER(Params, member)                                \
  Member {                                                    \
#member, offsetof(Params, member), sizeof(Params::member) \
  }

// The blocks whose members differ in size; Kernel creation compares the total size of every block at each
// dispatch.
TEST(InterfaceBlocks, OffsetsAreThoseOfCpp) {
  using namespace interface;
  expect_block(hash_half_edges_spv, sizeof(adjacency::HashParams),
               {MEMBER(adjacency::HashParams, half_edges), MEMBER(adjacency::HashParams, slots),
                MEMBER(adjacency::HashParams, slots_per_vertex)});
  expect_block(locate_shared_spv, sizeof(adjacency::SharedParams),
               {MEMBER(adjacency::SharedParams, count), MEMBER(adjacency::SharedParams, slots),
                MEMBER(adjacency::SharedParams, slots_per_vertex)});
  expect_block(join_coplanar_spv, sizeof(planar_groups::JoinParams),
               {MEMBER(planar_groups::JoinParams, alpha), MEMBER(planar_groups::JoinParams, sin_alpha),
                MEMBER(planar_groups::JoinParams, cos_alpha), MEMBER(planar_groups::JoinParams, count),
                MEMBER(planar_groups::JoinParams, angle_bits)});
  expect_block(
      make_area_keys_spv, sizeof(cooccurrence::KeyParams),
      {MEMBER(cooccurrence::KeyParams, triangles), MEMBER(cooccurrence::KeyParams, exponent_bits),
       MEMBER(cooccurrence::KeyParams, mantissa_bits), MEMBER(cooccurrence::KeyParams, least_exponent)});
  expect_block(scatter_digits_spv, sizeof(primitives::SortParams),
               {MEMBER(primitives::SortParams, count), MEMBER(primitives::SortParams, shift),
                MEMBER(primitives::SortParams, tiles)});
  const auto with_shape = [](std::vector<Member> members, std::size_t shape) {
    const Member inside[] = {MEMBER(spectrum::RowShape, radix), MEMBER(spectrum::RowShape, inner_bits),
                             MEMBER(spectrum::RowShape, inner_radices)};
    for (const Member& member : inside) members.push_back({member.name, shape + member.offset, member.size});
    return members;
  };
  expect_block(modulate_signals_spv, sizeof(spectrum::RowParams),
               with_shape({MEMBER(spectrum::RowParams, groups), MEMBER(spectrum::RowParams, groups_per_row),
                           MEMBER(spectrum::RowParams, first_row), MEMBER(spectrum::RowParams, first),
                           MEMBER(spectrum::RowParams, elements)},
                          offsetof(spectrum::RowParams, shape)));
  expect_block(
      total_magnitudes_spv, sizeof(spectrum::TotalParams),
      with_shape({MEMBER(spectrum::TotalParams, inverse_length), MEMBER(spectrum::TotalParams, segments),
                  MEMBER(spectrum::TotalParams, write_magnitudes), MEMBER(spectrum::TotalParams, window)},
                 offsetof(spectrum::TotalParams, shape)));
}

}  // namespace
}  // namespace scene_analyzer
