// area_classes.h — Which areas are one value: the attribute of the co-occurrence matrix, per triangle.
//
// Triangles are sorted by area within their mesh; a class starts at a value and takes the areas within 1.2e-7
// of it.
//
// Memory per triangle: class 4, class value 8; while it runs also keys 24, sorted areas 8, exits and
// starts 8. Cost: one radix sort, the rest linear.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/geometry.h"
#include "gpu/device.h"
#include "gpu/recorder.h"
#include "interface/cooccurrence.h"
#include "primitives/radix_sort.h"
#include "primitives/scan.h"

namespace scene_analyzer::cooccurrence {

struct AreaClasses {
  gpu::Array<std::uint32_t> class_of;                                // per triangle; 0 for degenerate ones
  gpu::Array<double> values;                                         // per class of the batch
  gpu::Array<interface::cooccurrence::ClassRange> ranges_on_device;  // per mesh
  std::vector<interface::cooccurrence::ClassRange> ranges;           // per mesh, after limit()
  std::vector<std::uint64_t> counts;  // classes per mesh under the limit, after limit()
};

class AreaClassBuilder {
 public:
  AreaClassBuilder(gpu::Device& device, const primitives::Scan& scan, const primitives::RadixSort& sort);

  // `results`: the geometry's per-mesh totals, with at least one kept triangle among them.
  AreaClasses record(gpu::Recorder& recorder, const geometry::Geometry& geometry,
                     std::span<const interface::mesh::GeometryTotals> results) const;

  // To be called once record() has run: meshes with more than `dim` classes get them merged (class_limit.h).
  void limit(gpu::Device& device, AreaClasses& classes, std::uint32_t dim) const;

 private:
  struct Blocks;
  void record_classes(gpu::Recorder& recorder, const geometry::Geometry& geometry,
                      const gpu::Array<std::uint32_t>& order,
                      std::span<const interface::mesh::GeometryTotals> results, AreaClasses& classes) const;

  const primitives::Scan& scan_;
  const primitives::RadixSort& sort_;
  gpu::Kernel make_keys_, gather_, find_exits_, walk_chain_, mark_starts_, number_, range_;
};

}  // namespace scene_analyzer::cooccurrence
