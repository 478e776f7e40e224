#include "cooccurrence/label_runs.h"

#include <bit>
#include <utility>

#include "interface/cooccurrence.h"
#include "key_shared_labels.spv.h"
#include "list_runs.spv.h"
#include "locate_mesh_runs.spv.h"
#include "mark_key_starts.spv.h"

namespace scene_analyzer::cooccurrence {

using namespace interface::cooccurrence;

LabelRunFinder::LabelRunFinder(gpu::Device& device, const primitives::Scan& scan,
                               const primitives::RadixSort& sort)
    : scan_(scan),
      sort_(sort),
      key_labels_(device.make_kernel("key_shared_labels", key_shared_labels_spv)),
      mark_starts_(device.make_kernel("mark_key_starts", mark_key_starts_spv)),
      list_runs_(device.make_kernel("list_runs", list_runs_spv)),
      locate_meshes_(device.make_kernel("locate_mesh_runs", locate_mesh_runs_spv)) {}

void LabelRunFinder::record_starts(gpu::Recorder& recorder, const primitives::KeyedValues& sorted,
                                   const gpu::Array<std::uint32_t>& starts) const {
  const SortedKeysParams params{static_cast<std::uint32_t>(starts.count() - 1)};
  recorder.run(mark_starts_, starts.count(), params, {sorted.low, sorted.high, starts});
  scan_.record(recorder, starts, starts.count());
}

LabelRuns LabelRunFinder::find(gpu::Device& device, const geometry::Geometry& geometry,
                               const adjacency::SharedEdges& shared, const gpu::Array<std::uint32_t>& labels,
                               std::uint32_t label_bits) const {
  LabelRuns runs;
  runs.label_bits = label_bits;
  runs.first_of_mesh.assign(geometry.records.size() + 1, 0);
  if (shared.count == 0) return runs;
  const auto count = static_cast<std::uint32_t>(shared.count);
  const auto meshes = static_cast<std::uint32_t>(geometry.records.size());
  gpu::Recorder recorder(device);
  primitives::KeyedValues keys = primitives::make_keyed_values(device, "shared labels", count);
  recorder.run(key_labels_, count, SharedLabelParams{count, label_bits},
               {labels, shared.half_edges, shared.begins, keys.low, keys.high, keys.values});
  const auto begin_bits = static_cast<std::uint32_t>(std::bit_width(count));
  runs.sorted = sort_.record(recorder, std::move(keys), count, begin_bits + label_bits);
  // One element more: after the scan it holds the number of runs.
  runs.starts = gpu::Array<std::uint32_t>(device, "run starts", shared.count + 1);
  runs.firsts = gpu::Array<std::uint32_t>(device, "run firsts", shared.count + 1);
  record_starts(recorder, runs.sorted, runs.starts);
  recorder.run(list_runs_, shared.count + 1, SortedKeysParams{count}, {runs.starts, runs.firsts});
  const gpu::Array<std::uint32_t> first_runs(device, "first runs", runs.first_of_mesh.size());
  recorder.run(locate_meshes_, runs.first_of_mesh.size(), MeshRunParams{count, meshes},
               {geometry.mesh_of, shared.half_edges, runs.starts, first_runs});
  recorder.submit_and_wait();
  runs.first_of_mesh = first_runs.download(device);
  runs.count = runs.first_of_mesh.back();
  return runs;
}

}  // namespace scene_analyzer::cooccurrence
