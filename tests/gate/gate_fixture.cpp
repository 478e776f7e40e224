#include "gate/gate_fixture.h"

#include <algorithm>

namespace scene_analyzer::gate {

analysis::AssetAnalysis analysis_of(const std::vector<TestMesh>& meshes) {
  analysis::AssetAnalysis asset;
  asset.computed = untimed();
  asset.files = {{.path = "a.glb", .found = true, .size = 600, .hash = {}},
                 {.path = "a.bin", .found = true, .size = 400, .hash = {}}};
  for (const TestMesh& mesh : meshes) {
    if (asset.geometries.size() <= mesh.geometry) asset.geometries.resize(mesh.geometry + 1);
    analysis::GeometryAnalysis& geometry = asset.geometries[mesh.geometry];
    geometry.mesh = mesh.geometry;
    geometry.source_triangles = geometry.triangles = mesh.triangles;
    geometry.surface_area = 1;
    geometry.polygons_per_planar_group = mesh.pppg;
    geometry.defects.emplace();
    analysis::InstanceAnalysis& instance = asset.instances.emplace_back();
    instance.geometry = mesh.geometry;
    instance.node = mesh.node;
    instance.mesh = mesh.mesh;
    instance.bounds = analysis::Bounds{{0, 0, 0}, {1, 1, 1}};
  }
  return asset;
}

analysis::MetricSet untimed() {
  return analysis::MetricSet().set().reset(index_of(analysis::Metric::kRenderingTime));
}

AssetState asset_of(const std::string& path, analysis::AssetAnalysis analysis, analysis::MetricSet metrics) {
  analysis.asset = path;
  return state_of(path, std::move(analysis), metrics, kDefaultWeights, std::nullopt);
}

AssetState asset_of(const std::string& path, const std::vector<TestMesh>& meshes) {
  return asset_of(path, analysis_of(meshes));
}

AssetState failed_asset(const std::string& path, const std::string& reason) {
  AssetState asset;
  asset.path = path;
  asset.failure = reason;
  return asset;
}

void set_time(analysis::AssetAnalysis& analysis, double milliseconds, const std::string& type,
              const std::string& device) {
  analysis::RenderTiming& timing = analysis.timings.emplace_back();
  timing.conditions.device = {.name = device, .driver = "driver", .type = type};
  timing.times.resize(analysis.geometries.size());
  timing.times.front().mean_ns = milliseconds * 1e6;
}

Budget one_rule(const std::string& lines) {
  return parse_budget("version = 1\n[[rule]]\nname = \"rule\"\n" + lines + "\n", "budget.toml");
}

}  // namespace scene_analyzer::gate
