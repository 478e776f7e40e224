// analysis.h — What was measured of one asset: the contents of an analysis file, as plain data.
//
// Everything here is independent of camera, weights and other assets; scene ratings are computed from it
// (ratings/). A value that was not computed, because its metric was not asked for or because the mesh was
// beyond a limit of the device, is absent, never zero.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/defects.h"
#include "analysis/metric.h"
#include "mesh/scene.h"

namespace scene_analyzer::analysis {

// What changes stored results, and `steps`, which rendering times are stored with.
struct Parameters {
  double alpha_degrees = 0;              // planar groups: largest angle between neighbours' normals, [0, 180]
  std::uint32_t dim = 20000;             // co-occurrence: largest number of area classes, >= 2
  double weld_tolerance = 0;             // local units, >= 0
  std::uint32_t steps = 8;               // rendering time: rotations per axis, >= 1
  std::uint64_t start_searches = 20000;  // Fourier transform: work on a component's start triangle, >= 1
  bool operator==(const Parameters&) const = default;
};

struct Bounds {
  mesh::Vector3 min{};
  mesh::Vector3 max{};
  bool operator==(const Bounds&) const = default;
};

// The one-dimensional signal behind the Fourier rating: areas by distance from the start triangle.
struct SignalSummary {
  std::uint64_t length = 0;          // triangles that have a neighbour
  std::uint32_t start_triangle = 0;  // of the largest component: index in the mesh
  double mean_distance = 0;          // from there to the other triangles of its component, along the surface
  double gap = 0;  // no triangle's mean distance is larger by more than this, relative; 0: proven the largest
  std::uint64_t searches = 0;  // work on the start triangle, in searches of the whole component
  bool operator==(const SignalSummary&) const = default;
};

// One geometry: a mesh of the asset in its local coordinates, or, under nodes whose linear part is not a
// similarity, the mesh transformed by that linear part.
struct GeometryAnalysis {
  std::uint32_t mesh = 0;                   // index in the asset
  mesh::Matrix3 linear = mesh::kIdentity3;  // applied before measuring; identity for similarities
  // XXH3-128 (low, high) of the mesh's indices and positions as imported: two meshes with the same hash have
  // the same shape, in whichever assets. Absent without source triangles and in files of older programs.
  std::optional<std::array<std::uint64_t, 2>> shape_hash;
  std::uint64_t source_triangles = 0;  // = triangles + degenerate_triangles
  std::uint64_t degenerate_triangles = 0;
  std::uint64_t triangles = 0;                        // n of the specification
  double surface_area = 0;                            // S in analysed coordinates
  std::optional<std::uint64_t> planar_groups;         // |PG|
  std::optional<std::uint64_t> largest_planar_group;  // triangles
  std::optional<std::uint64_t> components;            // connected through edges; isolated triangles count
  std::optional<std::uint64_t> isolated_triangles;    // triangles without a neighbour
  std::optional<std::uint64_t> non_manifold_edges;    // edges with more than two triangles
  std::optional<std::uint64_t> boundary_edges;        // edges with one triangle
  std::optional<std::uint64_t> area_classes;          // |S| after the DIM limit
  std::optional<double> polygons_per_planar_group;
  std::optional<double> planar_group_variation;
  std::optional<double> cooccurrence_contrast;
  std::optional<double> fourier_transform;
  std::optional<SignalSummary> signal;  // absent where fourier_transform is; its length may be 0
  std::optional<Defects> defects;       // absent without source triangles
  std::string no_fourier_transform;     // why that alone is absent although it was asked for; or empty
  std::string not_analysed;             // why everything above is absent, with need and limit; or empty
};

// Whether something that was asked for is missing because of a limit.
inline bool is_beyond_a_limit(const GeometryAnalysis& geometry) {
  return !geometry.not_analysed.empty() || !geometry.no_fourier_transform.empty();
}

struct InstanceAnalysis {
  std::uint32_t geometry = 0;  // index into AssetAnalysis::geometries
  std::string node;
  std::string mesh;       // name of the mesh
  double area_scale = 1;  // s^2 of the world matrix; 1 when the geometry's linear part holds it
  mesh::Matrix4 world = mesh::kIdentity4;
  std::optional<Bounds> bounds;  // world, axis-aligned, of kept triangles; absent when there are none
};

// A file that the results depend on.
struct FileFingerprint {
  std::string path;  // relative to the asset's folder; the asset itself is first
  bool found = true;
  std::uint64_t size = 0;
  std::array<std::uint64_t, 2> hash{};  // XXH3 128 bits: low, high
  bool operator==(const FileFingerprint&) const = default;
};

struct DeviceStamp {
  std::string name;
  std::string driver;
  std::string type;  // "discrete", "integrated", "virtual", "cpu" or "other"
  // Tells apart devices of the same name; see gpu::DeviceInfo. Kept with rendering times only.
  std::string id = {};
  bool operator==(const DeviceStamp&) const = default;
};

// How long one geometry takes to draw, alone. Per draw: means over the rotations.
struct RenderingTime {
  // Of the medians over the rounds of each rotation. 0: there was nothing to draw, or it was not measured.
  double mean_ns = 0;
  std::optional<double> confidence_ns;    // half of its 95 % interval; absent with too few rounds to tell
  double fastest_ns = 0, slowest_ns = 0;  // of the rotations' medians
  std::uint32_t rounds = 0;
  std::uint32_t rotations = 0;  // at most steps^2; fewer where the budget did not allow more
  std::optional<double> vertex_invocations, fragment_invocations;  // absent where the device does not count
  std::optional<double> overdraw;  // fragment invocations per covered pixel; absent without either
  std::string not_measured;        // why all that is missing; or empty
  bool operator==(const RenderingTime&) const = default;
};

// The rendering times of an asset on one device.
struct RenderTiming {
  // Times with the same conditions can be compared.
  struct Conditions {
    DeviceStamp device;
    std::uint32_t width = 512, height = 512;  // pixels
    std::uint32_t steps = 8;                  // rotations per axis
    bool operator==(const Conditions&) const = default;
  };
  Conditions conditions;
  double timestamp_period_ns = 0;    // of the device's clock
  double budget_seconds = 0;         // that was allowed for all times together
  std::vector<RenderingTime> times;  // one per geometry of the asset
  bool operator==(const RenderTiming&) const = default;
};

struct AssetAnalysis {
  std::string asset;  // path as given
  std::string format;
  std::optional<double> unit_scale;
  std::optional<std::string> up_axis;
  Parameters parameters;
  MetricSet computed;  // metrics whose stored part is present
  DeviceStamp device;
  std::vector<GeometryAnalysis> geometries;
  std::vector<InstanceAnalysis> instances;  // depth-first node order
  std::vector<FileFingerprint> files;
  std::vector<std::string> warnings;
  std::vector<RenderTiming> timings;  // the one asked for first; no two of one device, size and steps
};

inline bool is_beyond_a_limit(const AssetAnalysis& analysis) {
  return std::ranges::any_of(analysis.geometries, [](const auto& one) { return is_beyond_a_limit(one); });
}

}  // namespace scene_analyzer::analysis
