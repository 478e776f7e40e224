#include "report/fixture.h"

#include <stdlib.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace scene_analyzer::report {
namespace {

analysis::GeometryAnalysis leg() {
  analysis::GeometryAnalysis geometry;
  geometry.source_triangles = 41;
  geometry.degenerate_triangles = 1;
  geometry.triangles = 40;
  geometry.surface_area = 0.25;
  geometry.planar_groups = 12;
  geometry.largest_planar_group = 10;
  geometry.components = 1;
  geometry.isolated_triangles = 0;
  geometry.non_manifold_edges = 0;
  geometry.boundary_edges = 0;
  geometry.area_classes = 2;
  geometry.polygons_per_planar_group = ratings::polygons_per_planar_group(40, 12);
  geometry.planar_group_variation = ratings::planar_group_variation(40, 240);
  geometry.cooccurrence_contrast = 1.0 / 3;
  geometry.fourier_transform = 0.09168;
  geometry.defects.emplace().found = {
      {analysis::Defect::kDegenerateByShape, 1, {40}},
      {analysis::Defect::kInconsistentWinding, 12, {0, 1, 4, 5, 8, 9, 20, 33}},
      {analysis::Defect::kMergeableVertices, 3, {21, 22, 23}},
      {analysis::Defect::kFarFromOrigin, 1, {}}};
  geometry.signal = {.length = 40, .start_triangle = 17, .mean_distance = 0.35, .gap = 0, .searches = 23};
  return geometry;
}

analysis::InstanceAnalysis instance(std::uint32_t geometry, std::string node, std::string mesh, double x) {
  analysis::InstanceAnalysis result;
  result.geometry = geometry;
  result.node = std::move(node);
  result.mesh = std::move(mesh);
  result.bounds = analysis::Bounds{{x, -0.0, 0}, {x + 1, 1, 1}};
  return result;
}

analysis::RenderTiming timing(std::vector<double> means) {
  analysis::RenderTiming result;
  result.conditions = {{"llvmpipe (LLVM 15)", "Mesa 22.3.6", "cpu", "12ab, a processor"}, 640, 480, 8};
  result.timestamp_period_ns = 1;
  for (const double mean : means) {
    analysis::RenderingTime& time = result.times.emplace_back();
    if (mean == 0) continue;
    time = {.mean_ns = mean,
            .confidence_ns = 12.5,
            .fastest_ns = mean / 2,
            .slowest_ns = 2 * mean,
            .rounds = 7,
            .rotations = 64,
            .vertex_invocations = 120,
            .fragment_invocations = 5000.25,
            .overdraw = std::nullopt,
            .not_measured = {}};
  }
  return result;
}

}  // namespace

SceneReport Fixture::report() const {
  SceneReport report;
  report.tool_version = "0.1.0";
  report.device = {"llvmpipe (LLVM 15)", "Mesa 22.3.6", "cpu"};
  report.options = options;
  report.assets = assets;
  report.rating = ratings::rate(assets, options);
  return report;
}

Fixture two_assets() {
  Fixture fixture;
  analysis::AssetAnalysis room;
  room.asset = "models/room.glb";
  room.format = "glTF2";
  room.unit_scale = 1;
  room.up_axis = "+Y";
  room.geometries = {leg(), {}};
  room.instances = {instance(0, "leg left", "leg", 0), instance(0, "leg right", "leg", 3),
                    instance(1, "helper", "empty", 0)};
  room.instances[1].area_scale = 4;
  room.instances[2].bounds.reset();
  room.warnings = {"material \"oak\" names a texture that is missing: oak.png"};
  analysis::AssetAnalysis part;
  part.asset = "models/part.obj";
  part.format = "OBJ";
  part.geometries = {leg(), leg()};
  part.geometries[0].mesh = 0;
  part.geometries[0] = {};
  part.geometries[0].source_triangles = 900'000'000;
  part.geometries[0].not_analysed = "needs 40 GiB of device memory, the device has 2 GiB";
  part.geometries[1].mesh = 1;
  part.instances = {instance(0, "huge", "huge", 0),
                    instance(1, "", "say \"hi\", \x1b[31mred\x1b[0m\nnew\xff line \xc3\xa4\xe6\xbc\xa2", 8)};
  room.timings = {timing({1500, 0})};
  part.timings = {timing({0, 4500})};
  fixture.assets = {room, part};
  return fixture;
}

Fixture many_instances(std::size_t count) {
  Fixture fixture;
  analysis::AssetAnalysis asset;
  asset.asset = "many.glb";
  asset.format = "glTF2";
  asset.geometries = {leg()};
  for (std::size_t i = 0; i < count; ++i)
    asset.instances.push_back(instance(0, "node " + std::to_string(i), "leg", static_cast<double>(i)));
  fixture.assets = {std::move(asset)};
  return fixture;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "report-test-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;  // a leftover folder is no failure of the test
  std::filesystem::remove_all(path, ignored);
}

std::string contents_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace scene_analyzer::report
