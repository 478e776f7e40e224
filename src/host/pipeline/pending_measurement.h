// pending_measurement.h — A measurement of which only start triangles and spectra may be missing.
#pragma once

#include <cstdint>
#include <list>
#include <memory>

#include "pipeline/batch_run.h"
#include "pipeline/measure.h"

namespace scene_analyzer::pipeline {

class PendingMeasurement {
 public:
  // Returns when all batches have been on the device. Two of them are searched at the same time, at most.
  PendingMeasurement(Measurer::Stages& stages, Measurement measurement);

  // Its batches refer to it.
  PendingMeasurement(const PendingMeasurement&) = delete;
  PendingMeasurement& operator=(const PendingMeasurement&) = delete;

  // Whether finish() would have to wait.
  bool is_searching() const;
  // Waits for the search and transforms signals. Throws gpu::DeviceLost.
  void finish();

 private:
  // A batch's part in the progress: as much as its part of all triangles.
  struct Share {
    double whole = 0, done = 0;
  };
  void run(PlannedBatch plan, Share share);
  void run_halves(const PlannedBatch& plan, const Share& share);
  void report(Share& share, double fraction, const char* step);
  void refuse(std::uint32_t geometry, const char* reason);
  void finish_all_but(std::size_t count);

  Measurer::Stages& stages_;
  const Measurement measurement_;
  double done_ = 0;  // of all
  std::list<std::unique_ptr<BatchRun>> pending_;
};

}  // namespace scene_analyzer::pipeline
