// start_case.h — One mesh through the search for its start triangle, and through all pairs.
#pragma once

#include <cstdint>
#include <string>

#include "gpu/device.h"
#include "pipeline/stages.h"
#include "support/meshes.h"

namespace scene_analyzer::bench {

struct StartRow {
  std::string name;
  std::uint32_t triangles = 0;  // of the largest component
  std::uint64_t searches = 0;   // work, in searches of the whole component
  double seconds = 0;
  double gap = 0;
  double all_pairs_seconds = 0;
  bool extrapolated = false;
};

class StartBench {
 public:
  explicit StartBench(gpu::Device& device) : stages_(device) {}
  // Throws std::runtime_error when all pairs were computed and give another start triangle.
  StartRow run(const test_meshes::TestMesh& mesh);

 private:
  pipeline::Measurer::Stages stages_;
};

// The largest mesh of a model; "FILE@N": every triangle is cut into four N times.
test_meshes::TestMesh load(const std::string& file);

}  // namespace scene_analyzer::bench
