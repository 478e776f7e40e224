// gate_fixture.h — Assets as the gate sees them, made by hand.
#pragma once

#include <string>
#include <vector>

#include "gate/evaluate.h"

namespace scene_analyzer::gate {

struct TestMesh {
  std::string node, mesh;
  std::uint64_t triangles = 10;
  double pppg = 0.5;
  std::uint32_t geometry = 0;  // meshes of the same number share one; those must agree in what it has
};

// Every geometry has an area of 1 and no defects; two files of 600 and 400 bytes.
analysis::AssetAnalysis analysis_of(const std::vector<TestMesh>& meshes);
analysis::MetricSet untimed();
AssetState asset_of(const std::string& path, const std::vector<TestMesh>& meshes);
AssetState asset_of(const std::string& path, analysis::AssetAnalysis analysis,
                    analysis::MetricSet metrics = untimed());
AssetState failed_asset(const std::string& path, const std::string& reason);
// Of the first geometry.
void set_time(analysis::AssetAnalysis& analysis, double milliseconds, const std::string& type,
              const std::string& device = "Device");
// "version = 1" and a rule named "rule" with these lines.
Budget one_rule(const std::string& lines);

}  // namespace scene_analyzer::gate
