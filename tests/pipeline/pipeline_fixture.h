// pipeline_fixture.h — A pipeline on the test's device, an asset for it, and whether only its analysis file
// helps.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "pipeline/pipeline.h"
#include "pipeline/strip.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::pipeline {

// A folded strip of four triangles, two of them in one plane.
inline constexpr const char* kStrip =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 1\nv 2 1 1\no strip\nf 1 2 3\nf 1 3 4\nf 2 5 6\nf 2 6 3\n";

inline analysis::MetricSet only(analysis::Metric metric) {
  return analysis::MetricSet().set(index_of(metric));
}

class PipelineTest : public testing::Test {
 protected:
  // Rendering times take longer than everything else, and have tests of their own.
  PipelineTest() { options_.metrics.reset(index_of(analysis::Metric::kRenderingTime)); }

  std::filesystem::path strip() { return folder_.write("strip.obj", kStrip); }

  Outcome analyze(const std::filesystem::path& asset) {
    return Pipeline(options_, shared_device).analyze(asset);
  }

  // With a worker that ends at once and a device that must not be asked for: only an analysis file can help.
  Outcome analyze_from_file(const std::filesystem::path& asset) {
    setenv("SCENE_ANALYZER_TEST_WORKER", "exit", 1);
    Outcome outcome = Pipeline(options_, no_device).analyze(asset);
    unsetenv("SCENE_ANALYZER_TEST_WORKER");
    return outcome;
  }

  TemporaryFolder folder_;
  Options options_;
};

}  // namespace scene_analyzer::pipeline
