#include "cooccurrence/area_classes.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "cooccurrence/class_limit.h"
#include "find_class_exits.spv.h"
#include "gather_areas.spv.h"
#include "make_area_keys.spv.h"
#include "mark_class_starts.spv.h"
#include "number_classes.spv.h"
#include "range_classes.spv.h"
#include "walk_class_chain.spv.h"

namespace scene_analyzer::cooccurrence {

using namespace interface::cooccurrence;
using interface::mesh::Chunk;
using interface::mesh::GeometryTotals;

namespace {

// Leading mantissa bits that the sort looks at: areas that agree in them differ by less than 6e-11. Always as
// many, so that a mesh's areas have the same order whatever meshes are beside it.
constexpr std::uint32_t kSortedMantissaBits = 34;
constexpr std::uint32_t kMantissaBits = 52;

struct KeyLayout {
  KeyParams params;
  std::uint32_t bits;
};

std::uint32_t biased_exponent(double value) {
  return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(value) >> kMantissaBits);
}

// Mesh, exponent and mantissa: at most 17 + 11 + 34 bits. One value of the mesh's bits stays free for
// degenerate triangles.
KeyLayout key_layout(std::uint64_t triangles, std::span<const GeometryTotals> results) {
  std::uint32_t least = 2047, most = 0;
  for (const GeometryTotals& totals : results) {
    if (totals.kept == 0) continue;
    least = std::min(least, biased_exponent(totals.smallest_area));
    most = std::max(most, biased_exponent(totals.largest_area));
  }
  const auto mesh_bits = static_cast<std::uint32_t>(std::bit_width(results.size()));
  const auto exponent_bits = static_cast<std::uint32_t>(std::bit_width(most - least));
  return {.params = {.triangles = static_cast<std::uint32_t>(triangles),
                     .exponent_bits = exponent_bits,
                     .mantissa_bits = kSortedMantissaBits,
                     .least_exponent = least},
          .bits = mesh_bits + exponent_bits + kSortedMantissaBits};
}

}  // namespace

// Kept triangles of each mesh in the sorted list, cut into blocks.
struct AreaClassBuilder::Blocks {
  std::vector<SortedRange> ranges;
  std::vector<Chunk> blocks;
  std::uint32_t kept = 0;

  explicit Blocks(std::span<const GeometryTotals> results) {
    for (std::uint32_t mesh = 0; mesh < results.size(); ++mesh) {
      const std::uint32_t count = results[mesh].kept;
      ranges.push_back(
          {.first = kept, .count = count, .first_block = static_cast<std::uint32_t>(blocks.size())});
      for (std::uint32_t done = 0; done < count; done += kClassBlock)
        blocks.push_back({.first = kept + done, .count = std::min(kClassBlock, count - done), .mesh = mesh});
      kept += count;
    }
  }
};

AreaClassBuilder::AreaClassBuilder(gpu::Device& device, const primitives::Scan& scan,
                                   const primitives::RadixSort& sort)
    : scan_(scan),
      sort_(sort),
      make_keys_(device.make_kernel("make_area_keys", make_area_keys_spv)),
      gather_(device.make_kernel("gather_areas", gather_areas_spv)),
      find_exits_(device.make_kernel("find_class_exits", find_class_exits_spv)),
      walk_chain_(device.make_kernel("walk_class_chain", walk_class_chain_spv)),
      mark_starts_(device.make_kernel("mark_class_starts", mark_class_starts_spv)),
      number_(device.make_kernel("number_classes", number_classes_spv)),
      range_(device.make_kernel("range_classes", range_classes_spv)) {}

void AreaClassBuilder::record_classes(gpu::Recorder& recorder, const geometry::Geometry& geometry,
                                      const gpu::Array<std::uint32_t>& order,
                                      std::span<const GeometryTotals> results, AreaClasses& classes) const {
  gpu::Device& device = recorder.device();
  const Blocks plan(results);
  const SortedParams params{.count = plan.kept,
                            .triangles = static_cast<std::uint32_t>(geometry.triangle_count),
                            .blocks = static_cast<std::uint32_t>(plan.blocks.size()),
                            .meshes = static_cast<std::uint32_t>(results.size())};
  const auto& ranges = recorder.keep(gpu::Array<SortedRange>(device, "sorted ranges", plan.ranges.size()));
  const auto& blocks = recorder.keep(gpu::Array<Chunk>(device, "sorted blocks", plan.blocks.size()));
  ranges.upload(device, plan.ranges);
  blocks.upload(device, plan.blocks);
  const auto& sorted = recorder.keep(gpu::Array<double>(device, "sorted areas", params.count));
  const auto& exits = recorder.keep(gpu::Array<std::uint32_t>(device, "class exits", params.count));
  const auto& entries = recorder.keep(gpu::Array<std::uint32_t>(device, "class entries", params.blocks));
  // One element more than places: after the scan it holds the number of classes.
  const auto& starts = recorder.keep(gpu::Array<std::uint32_t>(device, "class starts", params.count + 1));

  recorder.run(gather_, params.count, params, {geometry.areas, order, sorted});
  recorder.run(find_exits_, params.blocks, params, {blocks, ranges, sorted, exits, entries});
  recorder.run(walk_chain_, params.meshes, params, {ranges, exits, entries});
  recorder.fill(starts, 0);
  recorder.run(mark_starts_, params.blocks, params, {blocks, sorted, entries, starts});
  scan_.record(recorder, starts, params.count + 1);
  recorder.run(number_, params.triangles, params, {order, sorted, starts, classes.class_of, classes.values});
  recorder.run(range_, params.meshes, params, {ranges, starts, classes.values, classes.ranges_on_device});
}

AreaClasses AreaClassBuilder::record(gpu::Recorder& recorder, const geometry::Geometry& geometry,
                                     std::span<const GeometryTotals> results) const {
  gpu::Device& device = recorder.device();
  const std::uint64_t triangles = geometry.triangle_count;
  AreaClasses classes{.class_of = gpu::Array<std::uint32_t>(device, "class of triangle", triangles),
                      .values = gpu::Array<double>(device, "class values", triangles),
                      .ranges_on_device = gpu::Array<ClassRange>(device, "class ranges", results.size()),
                      .ranges = {},
                      .counts = {}};
  const KeyLayout layout = key_layout(triangles, results);
  primitives::KeyedValues list = primitives::make_keyed_values(device, "area keys", triangles);
  recorder.run(make_keys_, triangles, layout.params,
               {geometry.areas, geometry.mesh_of, list.low, list.high, list.values});
  const auto& sorted = recorder.keep(sort_.record(recorder, std::move(list), triangles, layout.bits));
  record_classes(recorder, geometry, sorted.values, results, classes);
  return classes;
}

void AreaClassBuilder::limit(gpu::Device& device, AreaClasses& classes, std::uint32_t dim) const {
  classes.ranges = classes.ranges_on_device.download(device);
  bool changed = false;
  for (ClassRange& range : classes.ranges) {
    classes.counts.push_back(std::min(range.count, dim));
    if (range.count <= dim) continue;
    const std::vector<double> limited =
        limit_classes(classes.values.download(device, range.first, range.count), dim);
    classes.values.upload(device, limited, range.first);
    range.lowest = limited.front();
    range.highest = limited.back();
    changed = true;
  }
  if (changed) classes.ranges_on_device.upload(device, classes.ranges);
}

}  // namespace scene_analyzer::cooccurrence
