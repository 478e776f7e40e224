#include "cooccurrence/contrast.h"

#include <cstdint>

#include "combine_contrast.spv.h"
#include "interface/cooccurrence.h"
#include "list_shared_attributes.spv.h"
#include "sum_contrast.spv.h"

namespace scene_analyzer::cooccurrence {

using namespace interface::cooccurrence;

ContrastSummer::ContrastSummer(gpu::Device& device, const primitives::Scan& scan)
    : scan_(scan),
      list_shared_(device.make_kernel("list_shared_attributes", list_shared_attributes_spv)),
      sum_(device.make_kernel("sum_contrast", sum_contrast_spv)),
      combine_(device.make_kernel("combine_contrast", combine_contrast_spv)) {}

gpu::Array<double> ContrastSummer::record(gpu::Recorder& recorder, const geometry::Geometry& geometry,
                                          const adjacency::Adjacency& adjacency,
                                          const AreaClasses& classes) const {
  gpu::Device& device = recorder.device();
  const adjacency::SharedEdges& shared = adjacency.shared;
  // One element more: the scan's value there is the sum of all.
  const auto& sums = recorder.keep(gpu::Array<double>(device, "shared attributes", shared.count + 1));
  const auto& squares =
      recorder.keep(gpu::Array<double>(device, "squared shared attributes", shared.count + 1));
  const auto& rests =
      recorder.keep(gpu::Array<double>(device, "rests of squared shared attributes", shared.count + 1));
  if (shared.count > 0) {
    recorder.run(list_shared_, shared.count + 1, SharedValueParams{static_cast<std::uint32_t>(shared.count)},
                 {geometry.mesh_of, classes.class_of, classes.values, classes.ranges_on_device,
                  shared.half_edges, sums, squares, rests});
    scan_.record(recorder, sums, shared.count + 1);
    scan_.record(recorder, squares, shared.count + 1);
    scan_.record(recorder, rests, shared.count + 1);
  }
  gpu::Array<double> totals(device, "contrast totals", geometry.chunks.partial_count());
  const auto leaves = static_cast<std::uint32_t>(geometry.chunks.leaf_count());
  recorder.run(sum_, leaves, ContrastParams{leaves},
               {geometry.chunks.leaves(), adjacency.twin, classes.class_of, classes.values,
                classes.ranges_on_device, shared.ends, sums, squares, rests, totals});
  geometry.chunks.record_combine(recorder, combine_, totals);
  return totals;
}

}  // namespace scene_analyzer::cooccurrence
