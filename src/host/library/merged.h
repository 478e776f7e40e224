// merged.h — A library as one scene: what its meshes' ratings are against each other, as plain data.
//
// Everything is independent of where somebody stands: there is no R_d.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "library/output_folder.h"
#include "library/record.h"
#include "ratings/ratings.h"

namespace scene_analyzer::library {

// A distribution's shape; quantiles between two values are interpolated linearly.
inline constexpr std::array<double, 5> kQuantiles = {0.05, 0.25, 0.5, 0.75, 0.95};
struct Distribution {
  std::uint64_t count = 0;  // of values; all else is 0 without any
  double mean = 0, least = 0, greatest = 0;
  std::array<double, kQuantiles.size()> quantiles{};
};
// Cost: n log n.
Distribution distribution_of(std::vector<double> values);

// A mesh where it stands: a row of the library.
struct MergedMesh {
  std::uint32_t asset = 0;     // index into Merged::assets
  std::uint32_t instance = 0;  // of the asset
  std::uint64_t triangles = 0;
  std::array<std::uint64_t, 2> shape_hash{};
  std::optional<double> density, time_ns;
};

struct Offender {
  std::size_t mesh = 0;  // index into Merged::meshes
  double value = 0;
  std::uint64_t others = 0;  // meshes of the same shape and value, which are not listed
  std::string node, name;    // of its node, of itself
};

using Offenders = std::array<std::vector<Offender>, analysis::kMetricCount + 1>;

// Meshes of several assets that are the same: positions and indices, byte by byte.
struct Duplicate {
  std::array<std::uint64_t, 2> shape_hash{};
  std::uint64_t triangles = 0;
  std::vector<std::uint32_t> assets;  // that hold it, ascending, each once; at least two

  // That one copy for all assets would save.
  std::uint64_t redundant_triangles() const { return triangles * (assets.size() - 1); }
};

struct DefectTotals {
  std::uint64_t meshes = 0, count = 0;  // meshes that have it, each geometry once; how often in all
};

struct Merged {
  Manifest manifest;  // without assets
  // In the order of the library.
  std::vector<Record> assets;        // analysed
  std::vector<Record> not_analysed;  // incomplete or failed
  std::vector<std::string> missing;  // of which nothing is known; only where that was allowed
  std::vector<MergedMesh> meshes;    // asset by asset, in node order
  std::vector<ratings::OptionalRatings> ratings, relative_ratings;  // per mesh
  std::vector<std::optional<double>> aggregates;                    // per mesh
  std::uint64_t unique_triangles = 0, drawn_triangles = 0, degenerate_triangles = 0, bytes = 0;
  std::array<DefectTotals, analysis::kDefectCount> defects{};
  std::optional<double> density_mean, density_deviation;
  // What all rendering times were measured under, without `id` where several devices of one kind measured.
  std::optional<analysis::RenderTiming::Conditions> timing;
  std::uint32_t timing_devices = 0;  // how many measured
  bool mixed_timings = false;        // times of different kinds of devices: none is rated
  bool signed_aggregate = false;
  std::vector<Duplicate> duplicates;  // those that would save most triangles first
};

}  // namespace scene_analyzer::library
