// ratings.h — Analyses + camera -> seven ratings, aggregate, relative mode, colours. Pure functions: no GPU,
// no files.
//
// Formulas: docs/metrics.md (D. Kolb, LMU Munich 2017, with this project's rulings).
//
// What cannot be rated is absent, never zero and never infinite: a mesh without triangles or beyond a
// device's limit takes part in nothing; a mesh whose density or distance is no positive or finite number (a
// node scaled to 0, coordinates whose world positions overflow) lacks that rating alone and leaves that
// statistic.
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
  analysis::MetricSet metrics = analysis::MetricSet().set();                   // the others stay null
  std::array<double, analysis::kMetricCount> weights = {1, 1, 1, 1, 1, 1, 1};  // each >= 0
  bool relative = false;             // aggregate and colour from relative ratings
  std::optional<mesh::Vector3> eye;  // world; default: three-quarter view of the scene's bounds
};

// One mesh instance of the scene, in scene order (assets in the order given, then depth-first node order).
struct MeshRating {
  std::size_t asset = 0;           // index of the asset
  std::size_t instance = 0;        // index within the asset
  double surface_area = 0;         // world units squared; infinite where the coordinates overflow
  std::optional<double> density;   // triangles per unit area, finite and > 0; a fact, so also without R_rd
  std::optional<double> distance;  // D_m, world units, finite; a fact, so also without R_d
  // rt_m under SceneRating::timing; absent where it was not measured. A fact, so also without R_rt.
  std::optional<analysis::RenderingTime> rendering_time;
  OptionalRatings ratings;           // unmapped
  OptionalRatings relative_ratings;  // each mapped alone; R_rd signed
  std::optional<double> aggregate;   // [0,1]; R_rd alone: [-1,1]
};

struct SceneRating {
  std::vector<MeshRating> meshes;
  std::uint64_t unique_triangles = 0;       // kept triangles, every geometry of the file once
  std::uint64_t drawn_triangles = 0;        // kept triangles, every instance
  std::uint64_t degenerate_triangles = 0;   // every instance
  std::optional<analysis::Bounds> bounds;   // absent without triangles
  std::optional<mesh::Vector3> eye;         // given or derived; absent without triangles
  std::optional<double> density_mean;       // mu
  std::optional<double> density_deviation;  // sigma, population
  // What the rendering times were measured under: one device for all assets. Absent without any, and where
  // assets were measured under different conditions only, which is then said by `mixed_timings`.
  std::optional<analysis::RenderTiming::Conditions> timing;
  double timestamp_period_ns = 0;
  bool mixed_timings = false;
  bool signed_aggregate = false;  // aggregates are R_rd alone, in [-1,1]: pass it on to color()
};

// Cost: linear in the number of mesh instances.
SceneRating rate(std::span<const analysis::AssetAnalysis> assets, const Options& options);

// --- The single rules, for tests and other faces. Inputs of one scene; outputs in the same order. ---

// n >= 1 triangles in `groups` groups: (n - groups) / (n - 1), 0 for n = 1.
double polygons_per_planar_group(std::uint64_t triangles, std::uint64_t groups);
// sqrt(sum of squared sizes of groups with more than one triangle) / n; the sum is exact below 2^53.
double planar_group_variation(std::uint64_t triangles, double squared_sizes);
// From the magnitudes |X_0| = `zero` and |X_1|..|X_c| of a signal of `length` areas, c = floor(length / 2):
// their `largest`, their `sum` and `weighted_sum`, the sum of k |X_k|. 0 below two samples, or where the sum
// is at most 1e-12 |X_0|: rounding alone. In [0,1] for a signal without negative values.
double fourier_transform(double zero, double largest, double sum, double weighted_sum, std::uint64_t length);
struct DensityStatistics {
  double mean = 0, deviation = 0;
};
// Densities are finite and > 0. Two passes, in the order given, on values scaled by a power of two so that
// nothing overflows.
DensityStatistics density_statistics(std::span<const double> densities);
std::vector<double> relative_densities(std::span<const double> densities);     // [-1,1]
double distance_to(const analysis::Bounds& bounds, const mesh::Vector3& eye);  // 0 inside
std::vector<double> distance_ratings(std::span<const double> distances);       // [0,1]; distances are finite
mesh::Vector3 default_eye(const analysis::Bounds& scene);
std::vector<double> rendering_time_ratings(std::span<const double> times);  // [0,1]; times are finite
// Null ratings leave both sums; |R_rd| is used when it is combined with another metric of positive weight.
std::optional<double> aggregate(const OptionalRatings& ratings,
                                const std::array<double, analysis::kMetricCount>& weights);
// Every metric but R_d and R_rt mapped from its least..greatest value in the scene onto [0,1], R_rd onto
// [-1,1]; unchanged where these differ by at most 1e-5. Nulls stay null.
std::vector<OptionalRatings> relative_ratings(std::span<const OptionalRatings> ratings);
// True when R_rd is the only metric of positive weight that any mesh of the scene has: it keeps its sign
// then.
bool density_stands_alone(std::span<const OptionalRatings> ratings,
                          const std::array<double, analysis::kMetricCount>& weights);
// One aggregate per mesh, of unmapped `ratings`. Whether |R_rd| is taken is decided once for the scene, so
// that the rows of one table never mix signs. With options.relative the mapped ratings are combined, |R_rd|
// being taken before it is mapped onto [0,1].
std::vector<std::optional<double>> aggregates(std::span<const OptionalRatings> ratings,
                                              const Options& options);

enum class ColorMap { kThesis, kViridis, kCividis, kCoolwarm };
using Rgb = std::array<double, 3>;  // each in [0,1]
// `signed_range`: the value is R_rd alone, in [-1,1]; otherwise [0,1] (coolwarm is always centred at 0 over
// [-1,1]). Ratings outside the range are clamped to it.
Rgb color(double rating, ColorMap map = ColorMap::kThesis, bool signed_range = false);
// The mean of the rating colour and the luminance 0.299 R + 0.587 G + 0.114 B of the mesh's own colour.
Rgb mix_with_luminance(const Rgb& rating_color, const Rgb& original);
std::string to_hex(const Rgb& color);  // "#rrggbb"

}  // namespace scene_analyzer::ratings
