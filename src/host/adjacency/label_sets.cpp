#include "adjacency/label_sets.h"

#include <cstdint>

#include "flatten_labels.spv.h"
#include "init_labels.spv.h"
#include "interface/adjacency.h"

namespace scene_analyzer::adjacency {

using interface::adjacency::TriangleParams;

LabelSets::LabelSets(gpu::Device& device)
    : init_labels_(device.make_kernel("init_labels", init_labels_spv)),
      flatten_labels_(device.make_kernel("flatten_labels", flatten_labels_spv)) {}

void LabelSets::record_singletons(gpu::Recorder& recorder, const gpu::Array<std::uint32_t>& parent) const {
  recorder.run(init_labels_, parent.count(), TriangleParams{static_cast<std::uint32_t>(parent.count())},
               {parent});
}

void LabelSets::record_flatten(gpu::Recorder& recorder, const gpu::Array<std::uint32_t>& parent) const {
  recorder.run(flatten_labels_, parent.count(), TriangleParams{static_cast<std::uint32_t>(parent.count())},
               {parent});
}

}  // namespace scene_analyzer::adjacency
