// label_sets.h — Disjoint sets of triangles on the device; the label of a set is its lowest member.
#pragma once

#include <cstdint>

#include "gpu/device.h"
#include "gpu/recorder.h"

namespace scene_analyzer::adjacency {

class LabelSets {
 public:
  explicit LabelSets(gpu::Device& device);

  // Every element becomes a set of its own; kernels then unite sets with shaders/compute/lib/union_find.glsl.
  void record_singletons(gpu::Recorder& recorder, const gpu::Array<std::uint32_t>& parent) const;
  // parent[i] becomes the label of i's set.
  void record_flatten(gpu::Recorder& recorder, const gpu::Array<std::uint32_t>& parent) const;

 private:
  gpu::Kernel init_labels_, flatten_labels_;
};

}  // namespace scene_analyzer::adjacency
