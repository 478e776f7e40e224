// library_records.cpp — Writes the folder of a library that batch would have made: library_records FOLDER
// ASSETS MESHES, so many assets of so many meshes each, all different but for every hundredth.
#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "analysis_file/analysis_file.h"
#include "base/version.h"
#include "library/journal.h"
#include "library/output_folder.h"

namespace scene_analyzer {
namespace {

constexpr std::uint64_t kBytes = 1000;  // of each asset's file

analysis::GeometryAnalysis random_geometry(std::mt19937_64& random, std::uint32_t mesh) {
  const auto share = [&] { return static_cast<double>(random() % 1'000'000) / 1e6; };
  analysis::GeometryAnalysis geometry;
  geometry.mesh = mesh;
  geometry.triangles = geometry.source_triangles = 4 + random() % 10'000;
  geometry.surface_area = 0.01 + 100 * share();
  geometry.shape_hash = mesh % 100 == 0 ? std::array<std::uint64_t, 2>{7, mesh}
                                        : std::array<std::uint64_t, 2>{random(), random()};
  geometry.planar_groups = geometry.components = geometry.largest_planar_group = geometry.area_classes = 1;
  geometry.isolated_triangles = geometry.boundary_edges = geometry.non_manifold_edges = 0;
  geometry.polygons_per_planar_group = share();
  geometry.planar_group_variation = share();
  geometry.cooccurrence_contrast = share();
  geometry.fourier_transform = share();
  geometry.signal.emplace().length = 4;
  geometry.defects.emplace();
  return geometry;
}

analysis::AssetAnalysis random_asset(std::mt19937_64& random, const std::string& name, std::uint32_t meshes) {
  analysis::AssetAnalysis asset;
  asset.asset = name;
  asset.format = "generated";
  asset.computed.set();
  asset.computed.reset(index_of(analysis::Metric::kRenderingTime));
  asset.files = {{name, true, kBytes, {random(), random()}}};
  for (std::uint32_t mesh = 0; mesh < meshes; ++mesh) {
    asset.geometries.push_back(random_geometry(random, mesh));
    analysis::InstanceAnalysis instance;
    instance.geometry = mesh;
    instance.node = instance.mesh = fmt::format("mesh {}", mesh);
    instance.bounds = analysis::Bounds{{0, 0, 0}, {1, 1, 1}};
    asset.instances.push_back(std::move(instance));
  }
  return asset;
}

void write_library(const std::filesystem::path& folder, std::uint64_t assets, std::uint32_t meshes) {
  library::prepare_folder(folder);
  library::Manifest manifest;
  manifest.tool_version = version();
  manifest.metrics.set();
  library::Journal journal(folder, {});
  std::mt19937_64 random(1);
  std::vector<std::string> names;
  for (std::uint64_t i = 0; i < assets; ++i) {
    names.push_back(fmt::format("asset{:07}.glb", i));
    const auto analysis = random_asset(random, names.back(), meshes);
    library::Record record{.asset = names.back(), .status = library::Status::kAnalysed};
    record.analysis = fmt::format("analyses/{:03}/{}.analysis", i % 1000, names.back());
    record.bytes = kBytes;
    record.metrics = manifest.metrics;
    record.content_key = analysis_file::content_key(analysis);
    record.finished = library::utc_now();
    analysis_file::store(folder / record.analysis, analysis);
    journal.add(record);
    manifest.assets.push_back({names.back(), kBytes});
    manifest.shards.push_back(0);
  }
  journal.finish(names);
  library::write_manifest(folder, manifest);
}

}  // namespace
}  // namespace scene_analyzer

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: library_records FOLDER ASSETS MESHES\n");
    return 2;
  }
  scene_analyzer::write_library(argv[1], std::strtoull(argv[2], nullptr, 10),
                                static_cast<std::uint32_t>(std::strtoul(argv[3], nullptr, 10)));
  return 0;
}
