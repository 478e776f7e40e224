// subject.h — One case in memory: its scene, what device and twin make of it, checked against each other.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases.h"
#include "device_run.h"
#include "mesh/scene.h"
#include "pipeline/measure.h"
#include "twin_run.h"

namespace scene_analyzer::bench {

// The device with everything made once per process.
struct Bench {
  gpu::Device device;
  Kernels kernels{device};
  pipeline::Measurer measurer{device};
};

// One run on each side.
struct Round {
  Elapsed device, twin;
};

class Subject {
 public:
  // Measures once on both sides: throws std::runtime_error when they disagree.
  Subject(Bench& bench, const Case& of);

  const Case& which() const { return case_; }
  std::uint64_t triangles() const { return triangles_; }
  std::uint64_t peak_bytes() const { return peak_bytes_; }  // device buffers of the whole recipe

  // Stages are checked when the first of them is asked for.
  Round time_whole();
  Round time_stage(Stage stage);
  // The least of three runs, part by part. After time_stage().
  Profile profile(Stage stage);

 private:
  struct Runs {
    DeviceRun device;
    TwinRun twin;
  };
  std::vector<analysis::GeometryAnalysis> measure();
  Runs& runs();

  Bench& bench_;
  const Case& case_;
  mesh::Scene scene_;
  std::uint64_t triangles_ = 0, peak_bytes_ = 0;
  std::unique_ptr<Runs> runs_;
};

}  // namespace scene_analyzer::bench
