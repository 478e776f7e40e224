// device_run.h — One scene on its way through the stages on the device, each of them runnable again and
// again.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adjacency/adjacency.h"
#include "analysis/analysis.h"
#include "cooccurrence/area_classes.h"
#include "cooccurrence/contrast.h"
#include "geometry/geometry.h"
#include "gpu/device.h"
#include "gpu/recorder.h"
#include "pipeline/stages.h"
#include "planar_groups/planar_groups.h"
#include "stages.h"

namespace scene_analyzer::bench {

// Everything that runs on the device, made once.
using Kernels = pipeline::Measurer::Stages;

// Where the time of one stage went: kernels in order of first use, then whatever the host did.
struct Profile {
  Stage stage;
  std::vector<std::pair<std::string, double>> parts;  // seconds
};

class DeviceRun {
 public:
  // All meshes of the scene form one batch. `kernels` and `scene` must outlive the run.
  DeviceRun(const Kernels& kernels, const mesh::Scene& scene);

  // What the stage took with all its buffers, uploads and waits. The results of the stages before
  // must be there.
  Elapsed run(Stage stage);
  // The same with a timestamp around every dispatch.
  Profile profile(Stage stage);

  // What the stages found, per mesh; ratings but the contrast are left out. All stages must have run.
  std::vector<analysis::GeometryAnalysis> results() const;

 private:
  struct Recording;  // a recorder, and what is measured beside it
  void forget(Stage stage);
  void execute(Stage stage, Recording& recording);

  const Kernels& kernels_;
  const mesh::Scene& scene_;
  geometry::Batch batch_;
  geometry::Geometry geometry_;
  std::vector<interface::mesh::GeometryTotals> totals_;
  adjacency::Adjacency adjacency_;
  planar_groups::PlanarGroups groups_;
  cooccurrence::AreaClasses classes_;
  gpu::Array<double> contrast_;
};

}  // namespace scene_analyzer::bench
