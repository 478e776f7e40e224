// ratings.h — Analyses + camera -> seven ratings, aggregate, relative mode, colours. Pure functions: no GPU, no files.
//
// Formulas: docs/metrics.md (D. Kolb, LMU Munich 2017, with this project's rulings).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/analysis.h"

namespace scene_analyzer::ratings {

using OptionalRatings = std::array<std::optional<double>, analysis::kMetricCount>;

struct Options {
  analysis::MetricSet metrics = analysis::MetricSet().set();  // the others stay null
  std::array<double, analysis::kMetricCount> weights = {1, 1, 1, 1, 1, 1, 1};  // each >= 0
  bool relative = false;                   // aggregate and colour from relative ratings
  std::optional<mesh::Vector3> eye;        // world; default: three-quarter view of the scene's bounds
};

// One mesh instance of the scene, in scene order (assets in the order given, then depth-first node order).
struct MeshRating {
  std::size_t asset = 0;                   // index of the asset
  std::size_t instance = 0;                // index within the asset
  double surface_area = 0;                 // world units squared
  std::optional<double> density;           // triangles per unit area; absent without triangles
  std::optional<double> distance;          // D_m, world units
  OptionalRatings ratings;                 // unmapped
  OptionalRatings relative_ratings;        // each mapped alone; R_rd signed
  std::optional<double> aggregate;         // [0,1]; R_rd alone: [-1,1]
};

struct SceneRating {
  std::vector<MeshRating> meshes;
  std::uint64_t unique_triangles = 0;      // kept triangles, every geometry of the file once
  std::uint64_t drawn_triangles = 0;       // kept triangles, every instance
  std::uint64_t degenerate_triangles = 0;  // every instance
  std::optional<analysis::Bounds> bounds;  // absent without triangles
  std::optional<mesh::Vector3> eye;        // given or derived; absent without triangles
  std::optional<double> density_mean;      // mu
  std::optional<double> density_deviation; // sigma, population
};

// Cost: linear in the number of mesh instances.
SceneRating rate(std::span<const analysis::AssetAnalysis> assets, const Options& options);

// --- The single rules, for tests and other faces. Inputs of one scene; outputs in the same order. ---

// n >= 1 triangles in `groups` groups: (n - groups) / (n - 1), 0 for n = 1.
double polygons_per_planar_group(std::uint64_t triangles, std::uint64_t groups);
// sqrt(sum of squared sizes of groups with more than one triangle) / n; the sum is exact below 2^53.
double planar_group_variation(std::uint64_t triangles, double squared_sizes);
struct DensityStatistics {
  double mean = 0, deviation = 0;
};
DensityStatistics density_statistics(std::span<const double> densities);
std::vector<double> relative_densities(std::span<const double> densities);   // [-1,1]
double distance_to(const analysis::Bounds& bounds, const mesh::Vector3& eye); // 0 inside
std::vector<double> distance_ratings(std::span<const double> distances);     // [0,1]
mesh::Vector3 default_eye(const analysis::Bounds& scene);
// Null ratings leave both sums; |R_rd| is used when it is combined with another metric of positive weight.
std::optional<double> aggregate(const OptionalRatings& ratings,
                                const std::array<double, analysis::kMetricCount>& weights);

enum class ColorMap { kThesis, kViridis, kCividis, kCoolwarm };
using Rgb = std::array<double, 3>;  // each in [0,1]
// `signed_range`: the value is R_rd alone, in [-1,1]; otherwise [0,1] (coolwarm is always centred at 0 over [-1,1]).
Rgb color(double rating, ColorMap map = ColorMap::kThesis, bool signed_range = false);
// The mean of the rating colour and the luminance 0.299 R + 0.587 G + 0.114 B of the mesh's own colour.
Rgb mix_with_luminance(const Rgb& rating_color, const Rgb& original);
std::string to_hex(const Rgb& color);  // "#rrggbb"

}  // namespace scene_analyzer::ratings
