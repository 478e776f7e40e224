// stages.h — Kernels of every stage, made once per device.
#pragma once

#include <optional>

#include "adjacency/adjacency.h"
#include "cooccurrence/area_classes.h"
#include "cooccurrence/contrast.h"
#include "cooccurrence/histogram.h"
#include "defects/defect_finder.h"
#include "geometry/geometry.h"
#include "pipeline/measure.h"
#include "planar_groups/planar_groups.h"
#include "primitives/radix_sort.h"
#include "primitives/scan.h"
#include "spectrum/spectrum.h"
#include "surface_distances/arcs.h"

namespace scene_analyzer::pipeline {

struct Measurer::Stages {
  gpu::Device& device;
  primitives::Scan scan{device};
  primitives::RadixSort sort{device, scan};
  geometry::GeometryBuilder geometry{device};
  adjacency::AdjacencyBuilder adjacency{device, sort};
  defects::DefectFinder defects{device};
  planar_groups::PlanarGroupBuilder planar{device, scan, sort};
  cooccurrence::AreaClassBuilder classes{device, scan, sort};
  cooccurrence::ContrastSummer contrast{device, scan};
  surface_distances::ArcMeasurer arcs{device};
  spectrum::SpectrumBuilder spectra;
  std::optional<cooccurrence::HistogramBuilder> histograms;  // made when somebody asks

  explicit Stages(gpu::Device& on, const spectrum::SpectrumLimits& limits = {})
      : device(on), spectra(on, limits) {}
};

}  // namespace scene_analyzer::pipeline
