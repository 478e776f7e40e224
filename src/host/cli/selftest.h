// selftest.h — Known results, computed on one device: the reference values of docs/metrics.md that concern
// geometry.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "cli/selftest_meshes.h"
#include "gpu/device.h"

namespace scene_analyzer::cli {

struct Check {
  std::string mesh;
  std::string value;  // a metric's key or a count's field name
  double expected = 0;
  std::optional<double> got;  // absent: the device gave nothing
  double tolerance = 0;       // 0 for counts, 1e-5 for ratings

  bool good() const;
};

std::vector<BuiltInMesh> selftest_meshes();

// `measured`: one geometry per mesh of selftest_meshes(), in their order; missing ones fail.
std::vector<Check> compare(const std::vector<analysis::GeometryAnalysis>& measured);

// Measures all built-in meshes as one scene. Throws gpu::Error.
std::vector<Check> run_selftest(gpu::Device& device);

}  // namespace scene_analyzer::cli
