// sample.h — A folder that goes away with its test, and an analysis with a value in every field.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "analysis_file/analysis_file.h"

namespace scene_analyzer::analysis_file {

namespace fs = std::filesystem;

inline void write_text(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  ASSERT_TRUE(out.good()) << path;
}

inline std::string read_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class FolderTest : public testing::Test {
 protected:
  FolderTest() {
    std::string pattern = (fs::temp_directory_path() / "analysis-file-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder = pattern;
  }
  ~FolderTest() override { fs::remove_all(folder); }

  // How many entries lie in the folder, whatever their kind.
  static std::ptrdiff_t entries(const fs::path& in) {
    return std::distance(fs::directory_iterator(in), fs::directory_iterator());
  }

  fs::path folder;
};

inline analysis::GeometryAnalysis full_geometry() {
  analysis::GeometryAnalysis g;
  g.mesh = 7;
  g.linear = {1, 2, 3, 4, 5, 6, 7, 8, -0.0};
  g.shape_hash = {1, UINT64_MAX};
  g.source_triangles = 5'000'000'003;
  g.degenerate_triangles = 3;
  g.triangles = 5'000'000'000;
  g.surface_area = 0.1 + 0.2;
  g.planar_groups = 4'999'999'999;
  g.largest_planar_group = 2;
  g.components = 11;
  g.isolated_triangles = 12;
  g.non_manifold_edges = 13;
  g.boundary_edges = 14;
  g.area_classes = 15;
  g.polygons_per_planar_group = 1.0 / 3;
  g.planar_group_variation = 5e-324;
  g.cooccurrence_contrast = std::nextafter(1.0, 0.0);
  g.fourier_transform = 0.519230769;
  g.signal = {4'999'999'988, 4'294'967'295, 0.1 + 0.7, 5e-324, 5'000'000'001};
  using analysis::Defect;
  g.defects.emplace().found = {{Defect::kDegenerateByIndex, 2, {0, 4'294'967'295}},
                               {Defect::kDegenerateByShape, 1, {7}},
                               {Defect::kDuplicateTriangles, 5'000'000'000, {1, 2, 3, 4, 5, 6, 7, 8}},
                               {Defect::kNonManifoldEdges, 13, {9}},
                               {Defect::kBoundaryEdges, 14, {3, 5}},
                               {Defect::kInconsistentWinding, 1, {4}},
                               {Defect::kIsolatedTriangles, 12, {4'294'967'294}},
                               {Defect::kUnreferencedVertices, 1, {4'294'967'295}},
                               {Defect::kNonFiniteVertices, 2, {0, 1}},
                               {Defect::kMergeableVertices, 3, {2}},
                               {Defect::kFarFromOrigin, 1, {}}};
  return g;
}

// Of three geometries, the last of which has nothing to draw.
inline analysis::RenderTiming full_timing(analysis::DeviceStamp device) {
  analysis::RenderTiming timing;
  timing.conditions = {std::move(device), 640, 1, 4};
  timing.conditions.device.id = "12ab, a processor";
  timing.timestamp_period_ns = 0.1 + 0.2;
  timing.budget_seconds = 0.3;
  timing.times.push_back({.mean_ns = 1e-300,
                          .confidence_ns = 0.0,
                          .fastest_ns = 0,
                          .slowest_ns = 1e300,
                          .rounds = 4'294'967'295,
                          .rotations = 1,
                          .vertex_invocations = 0.0,
                          .fragment_invocations = 1.0 / 3,
                          .overdraw = 5e-324,
                          .not_measured = {}});
  analysis::RenderingTime plain;
  plain.mean_ns = plain.fastest_ns = plain.slowest_ns = 17;
  plain.rounds = plain.rotations = 1;
  timing.times.push_back(plain);
  timing.times.emplace_back();
  return timing;
}

inline analysis::AssetAnalysis full_analysis() {
  analysis::AssetAnalysis a;
  a.asset = std::string("a folder/\xff\xfe not UTF-8\n.obj");
  a.format = "Wavefront \xe9";
  a.unit_scale = 0.01;
  a.up_axis = "-Z";
  a.parameters = {12.5, 300, 1e-7, 4, 5'000'000'002};
  a.computed.set(0).set(3).set(4).set(analysis::index_of(analysis::Metric::kRenderingTime));
  a.device = {"llvmpipe \xe9", "Mesa 22.3.6", "cpu"};
  analysis::GeometryAnalysis zeros;  // every optional present and zero, which is not absent
  zeros.planar_groups = zeros.largest_planar_group = zeros.components = zeros.isolated_triangles = 0;
  zeros.non_manifold_edges = zeros.boundary_edges = zeros.area_classes = 0;
  zeros.polygons_per_planar_group = zeros.planar_group_variation = 0.0;
  zeros.cooccurrence_contrast = zeros.fourier_transform = -0.0;
  zeros.signal.emplace();
  zeros.shape_hash = {0, 0};
  zeros.defects.emplace();  // none, which is not absent
  analysis::GeometryAnalysis refused;
  refused.source_triangles = 9;
  refused.not_analysed = "needs 3 GiB, the device has 2 GiB";
  a.geometries = {full_geometry(), zeros, refused};
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  a.instances.push_back({2,
                         "n\xc3\xb6"
                         "de",
                         std::string("me\0sh", 5), 1, mesh::kIdentity4, std::nullopt});
  a.instances.push_back(
      {0, "", "", 2.25, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 0, 1}, {{{-1, -2, -3}, {1, 2, 3}}}});
  a.instances.push_back(
      {1, "x", "y", 0, {1, 0, 0, kNan, 0, 1, 0, -0.0, 0, 0, 1, 0, 0, 0, 1, 1}, {{{0, 0, 0}, {0, 0, 0}}}});
  a.files = {{"room.obj", true, 123, {1, UINT64_MAX}},
             {"no\xffthere.mtl", false, 0, {0, 0}},
             {"sub/x.bin", true, 0, {5, 6}}};
  a.warnings = {"first \xff", "", "third"};
  a.timings = {full_timing({"GPU \xe9", "", "discrete"}), full_timing({"llvmpipe", "Mesa 22.3.6", "cpu"})};
  return a;
}

// As many geometries, all alike, and no rendering times.
inline void replace_geometries(analysis::AssetAnalysis& analysis, std::size_t count) {
  analysis.geometries.assign(count, full_geometry());
  analysis.timings.clear();
  analysis.computed.reset(analysis::index_of(analysis::Metric::kRenderingTime));
}

// By bits, so that -0, NaN and the last digit count.
template <typename Numbers>
void expect_same_bits(const Numbers& a, const Numbers& b, const char* what) {
  ASSERT_EQ(std::size(a), std::size(b));
  for (std::size_t i = 0; i < std::size(a); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a[i]), std::bit_cast<std::uint64_t>(b[i])) << what << " " << i;
}

inline void expect_same(const analysis::GeometryAnalysis& a, const analysis::GeometryAnalysis& b) {
  EXPECT_EQ(a.mesh, b.mesh);
  expect_same_bits(a.linear, b.linear, "linear");
  EXPECT_EQ(a.shape_hash, b.shape_hash);
  EXPECT_EQ(a.source_triangles, b.source_triangles);
  EXPECT_EQ(a.degenerate_triangles, b.degenerate_triangles);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.surface_area, b.surface_area);
  EXPECT_EQ(a.planar_groups, b.planar_groups);
  EXPECT_EQ(a.largest_planar_group, b.largest_planar_group);
  EXPECT_EQ(a.components, b.components);
  EXPECT_EQ(a.isolated_triangles, b.isolated_triangles);
  EXPECT_EQ(a.non_manifold_edges, b.non_manifold_edges);
  EXPECT_EQ(a.boundary_edges, b.boundary_edges);
  EXPECT_EQ(a.area_classes, b.area_classes);
  EXPECT_EQ(a.polygons_per_planar_group, b.polygons_per_planar_group);
  EXPECT_EQ(a.planar_group_variation, b.planar_group_variation);
  EXPECT_EQ(a.cooccurrence_contrast, b.cooccurrence_contrast);
  EXPECT_EQ(a.fourier_transform, b.fourier_transform);
  EXPECT_EQ(a.signal, b.signal);
  EXPECT_EQ(a.defects, b.defects);
  EXPECT_EQ(a.not_analysed, b.not_analysed);
}

inline void expect_same(const analysis::InstanceAnalysis& a, const analysis::InstanceAnalysis& b) {
  EXPECT_EQ(a.geometry, b.geometry);
  EXPECT_EQ(a.node, b.node);
  EXPECT_EQ(a.mesh, b.mesh);
  EXPECT_EQ(a.area_scale, b.area_scale);
  expect_same_bits(a.world, b.world, "world");
  EXPECT_EQ(a.bounds, b.bounds);
}

inline void expect_same(const analysis::AssetAnalysis& a, const analysis::AssetAnalysis& b) {
  EXPECT_EQ(a.asset, b.asset);
  EXPECT_EQ(a.format, b.format);
  EXPECT_EQ(a.unit_scale, b.unit_scale);
  EXPECT_EQ(a.up_axis, b.up_axis);
  EXPECT_EQ(a.parameters, b.parameters);
  EXPECT_EQ(a.computed, b.computed);
  EXPECT_EQ(a.device.name, b.device.name);
  EXPECT_EQ(a.device.driver, b.device.driver);
  EXPECT_EQ(a.device.type, b.device.type);
  EXPECT_EQ(a.files, b.files);
  EXPECT_EQ(a.warnings, b.warnings);
  EXPECT_TRUE(a.timings == b.timings);
  ASSERT_EQ(a.geometries.size(), b.geometries.size());
  for (std::size_t i = 0; i < a.geometries.size(); ++i) expect_same(a.geometries[i], b.geometries[i]);
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) expect_same(a.instances[i], b.instances[i]);
}

}  // namespace scene_analyzer::analysis_file
