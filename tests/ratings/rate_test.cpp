// rate(): analyses in, one row per mesh instance out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "ratings/ratings.h"

namespace scene_analyzer::ratings {
namespace {

using analysis::AssetAnalysis;
using analysis::Bounds;
using analysis::GeometryAnalysis;
using analysis::index_of;
using analysis::InstanceAnalysis;
using analysis::Metric;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

GeometryAnalysis geometry(std::uint32_t mesh, std::uint64_t triangles, double area) {
  GeometryAnalysis result;
  result.mesh = mesh;
  result.source_triangles = triangles + 1;
  result.degenerate_triangles = 1;
  result.triangles = triangles;
  result.surface_area = area;
  result.polygons_per_planar_group = 0.25;
  result.planar_group_variation = 0.5;
  result.cooccurrence_contrast = 0.75;
  return result;
}

InstanceAnalysis instance(std::uint32_t of, double x, double scale = 1) {
  InstanceAnalysis result;
  result.geometry = of;
  result.area_scale = scale;
  result.bounds = Bounds{{x, 0, 0}, {x + 1, 1, 1}};
  return result;
}

AssetAnalysis asset(std::vector<GeometryAnalysis> geometries, std::vector<InstanceAnalysis> instances) {
  AssetAnalysis result;
  result.geometries = std::move(geometries);
  result.instances = std::move(instances);
  return result;
}

std::optional<double> rating(const MeshRating& mesh, Metric metric) {
  return mesh.ratings[index_of(metric)];
}

TEST(Rate, AnEmptySceneHasNoStatistics) {
  const SceneRating scene = rate({}, {});
  EXPECT_TRUE(scene.meshes.empty());
  EXPECT_FALSE(scene.bounds || scene.eye || scene.density_mean || scene.density_deviation);
  EXPECT_EQ(scene.drawn_triangles + scene.unique_triangles + scene.degenerate_triangles, 0u);
}

analysis::RenderTiming timing(const std::string& device, std::vector<double> means) {
  analysis::RenderTiming result;
  result.conditions.device = {device, "driver", "discrete"};
  for (const double mean : means) result.times.emplace_back().mean_ns = mean;
  return result;
}

TEST(Rate, RenderingTimesAreRatedByGeometryWithinTheScene) {
  AssetAnalysis room = asset({geometry(0, 10, 5), geometry(1, 100, 5), geometry(2, 7, 5)},
                             {instance(1, 0), instance(0, 5), instance(1, 9), instance(2, 0)});
  room.timings = {timing("A", {100, 400, 200})};
  room.timings[0].times[2] = {};
  room.timings[0].times[2].not_measured = "too large";
  AssetAnalysis part = asset({geometry(0, 10, 5)}, {instance(0, 0)});
  part.timings = {timing("A", {200})};
  const std::vector<AssetAnalysis> assets = {room, part};
  const SceneRating scene = rate(assets, {});
  std::vector<std::optional<double>> found;
  for (const MeshRating& mesh : scene.meshes) found.push_back(rating(mesh, Metric::kRenderingTime));
  EXPECT_EQ(found, (std::vector<std::optional<double>>{1, 0, 1, std::nullopt, 1.0 / 3}));
  EXPECT_EQ(scene.meshes[3].rendering_time->not_measured, "too large");
  EXPECT_EQ(scene.timing->device.name, "A");
  EXPECT_FALSE(scene.mixed_timings);
}

TEST(Rate, RenderingTimesOfTwoDevicesAreNeverMixed) {
  AssetAnalysis one = asset({geometry(0, 10, 5)}, {instance(0, 0)}), other = one, untimed = one;
  one.timings = {timing("A", {100}), timing("B", {30})};
  other.timings = {timing("C", {1}), timing("B", {60})};
  std::vector<AssetAnalysis> assets = {one, other, untimed};
  SceneRating scene = rate(assets, {});
  EXPECT_EQ(scene.timing->device.name, "B");
  EXPECT_EQ(rating(scene.meshes[0], Metric::kRenderingTime), 0);
  EXPECT_EQ(rating(scene.meshes[1], Metric::kRenderingTime), 1);
  EXPECT_EQ(rating(scene.meshes[2], Metric::kRenderingTime), std::nullopt);

  const std::vector<AssetAnalysis> good = assets;
  assets[1].timings[1].conditions.device.id = "another machine";
  EXPECT_TRUE(rate(assets, {}).mixed_timings);
  assets = good;
  assets[1].timings[1].conditions.steps = 4;
  scene = rate(assets, {});
  EXPECT_TRUE(scene.mixed_timings);
  EXPECT_FALSE(scene.timing);
  for (const MeshRating& mesh : scene.meshes) {
    EXPECT_FALSE(mesh.rendering_time);
    EXPECT_EQ(rating(mesh, Metric::kRenderingTime), std::nullopt);
  }
}

TEST(Rate, GivesInstancesTheRatingsOfTheirGeometry) {
  const AssetAnalysis room =
      asset({geometry(0, 10, 5), geometry(1, 100, 5)}, {instance(1, 0), instance(0, 5), instance(1, 9, 4)});
  const SceneRating scene = rate(std::span(&room, 1), {});
  ASSERT_EQ(scene.meshes.size(), 3u);
  for (const MeshRating& mesh : scene.meshes) {
    EXPECT_EQ(rating(mesh, Metric::kPolygonsPerPlanarGroup), 0.25);
    EXPECT_EQ(rating(mesh, Metric::kPlanarGroupVariation), 0.5);
    EXPECT_EQ(rating(mesh, Metric::kCooccurrenceContrast), 0.75);
    EXPECT_EQ(rating(mesh, Metric::kFourierTransform), std::nullopt);
    EXPECT_EQ(rating(mesh, Metric::kRenderingTime), std::nullopt);
  }
  EXPECT_EQ(scene.meshes[2].surface_area, 20);
  EXPECT_EQ(scene.meshes[0].density, 20);
  EXPECT_EQ(scene.meshes[1].density, 2);
  EXPECT_EQ(scene.meshes[2].density, 5);
  EXPECT_EQ(scene.unique_triangles, 110u);
  EXPECT_EQ(scene.drawn_triangles, 210u);
  EXPECT_EQ(scene.degenerate_triangles, 3u);
  EXPECT_EQ(*scene.density_mean, 9);
  EXPECT_NEAR(*scene.density_deviation, std::sqrt((121.0 + 49 + 16) / 3), 1e-12);
}

TEST(Rate, ReproducesThePrintedDensitiesAndDistances) {
  const std::vector<double> densities = {0.0369505, 0.0558266, 0.179589, 0.40802, 0.535204, 0.56065};
  AssetAnalysis room;
  for (std::uint32_t i = 0; i < 6; ++i) {
    room.geometries.push_back(geometry(i, 1000, 1000 / densities[i]));
    room.instances.push_back(instance(i, i < 3 ? std::array{1.66838, 1.73882, 1.81755}[i] : 1.7));
  }
  Options options;
  options.eye = mesh::Vector3{0, 0.5, 0.5};
  const SceneRating scene = rate(std::span(&room, 1), options);
  const std::vector<double> printed = {-1, -0.784423, -0.270428, 0.260045, 0.741934, 1};
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(*rating(scene.meshes[i], Metric::kRelativeDensity), printed[i], 2e-5);
  EXPECT_NEAR(*scene.density_mean, 0.29604, 5e-7);
  EXPECT_NEAR(*scene.density_deviation, 0.215309, 5e-7);
  EXPECT_DOUBLE_EQ(*scene.meshes[1].distance, 1.73882);
  EXPECT_EQ(rating(scene.meshes[0], Metric::kDistance), 0);
  EXPECT_NEAR(*rating(scene.meshes[1], Metric::kDistance), 0.472204, 1e-5);
  EXPECT_EQ(rating(scene.meshes[2], Metric::kDistance), 1);
}

TEST(Rate, SpansAllAssetsInOrder) {
  const std::vector<AssetAnalysis> assets = {asset({geometry(0, 10, 1)}, {instance(0, 0), instance(0, 2)}),
                                             asset({geometry(0, 30, 1)}, {instance(0, 9)})};
  const SceneRating scene = rate(assets, {});
  ASSERT_EQ(scene.meshes.size(), 3u);
  EXPECT_EQ(scene.meshes[1].asset, 0u);
  EXPECT_EQ(scene.meshes[1].instance, 1u);
  EXPECT_EQ(scene.meshes[2].asset, 1u);
  EXPECT_EQ(scene.meshes[2].instance, 0u);
  EXPECT_EQ(*scene.bounds, (Bounds{{0, 0, 0}, {10, 1, 1}}));
  EXPECT_EQ(*scene.eye, default_eye(*scene.bounds));
  EXPECT_EQ(scene.unique_triangles, 40u);
}

TEST(Rate, CountsAShearedMeshOnceAsUnique) {
  const AssetAnalysis room = asset({geometry(0, 9, 1), geometry(0, 10, 2), geometry(3, 4, 1)},
                                   {instance(0, 0), instance(1, 0), instance(2, 0)});
  const SceneRating scene = rate(std::span(&room, 1), {});
  EXPECT_EQ(scene.unique_triangles, 14u);
  EXPECT_EQ(scene.drawn_triangles, 23u);
}

TEST(Rate, MeshesWithoutTrianglesKeepTheirRowAndNothingElse) {
  AssetAnalysis room = asset({geometry(0, 10, 5), geometry(1, 0, 0), geometry(2, 20, 5)},
                             {instance(0, 0), instance(1, 100), instance(2, 3)});
  room.geometries[1].polygons_per_planar_group = 0;
  room.instances[1].bounds.reset();
  AssetAnalysis without = room;
  without.instances.erase(without.instances.begin() + 1);

  const SceneRating scene = rate(std::span(&room, 1), {});
  const SceneRating expected = rate(std::span(&without, 1), {});
  ASSERT_EQ(scene.meshes.size(), 3u);
  EXPECT_EQ(scene.meshes[1].ratings, OptionalRatings{});
  EXPECT_EQ(scene.meshes[1].relative_ratings, OptionalRatings{});
  EXPECT_FALSE(scene.meshes[1].aggregate || scene.meshes[1].density || scene.meshes[1].distance);
  EXPECT_EQ(scene.meshes[0].ratings, expected.meshes[0].ratings);
  EXPECT_EQ(scene.meshes[2].ratings, expected.meshes[1].ratings);
  EXPECT_EQ(scene.density_mean, expected.density_mean);
  EXPECT_EQ(scene.bounds, expected.bounds);
}

TEST(Rate, MeshesThatWereNotAnalysedAreInNoStatistic) {
  AssetAnalysis room = asset({geometry(0, 10, 5), geometry(1, 20, 5)}, {instance(0, 0), instance(1, 50)});
  room.geometries[1].not_analysed = "needs 9 GiB, the device has 2 GiB";
  const SceneRating scene = rate(std::span(&room, 1), {});
  EXPECT_EQ(scene.meshes[1].ratings, OptionalRatings{});
  EXPECT_FALSE(scene.meshes[1].aggregate || scene.meshes[1].density || scene.meshes[1].distance);
  EXPECT_EQ(*scene.density_mean, 2);
  EXPECT_EQ(scene.bounds->max[0], 1);
  EXPECT_EQ(rating(scene.meshes[0], Metric::kRelativeDensity), 0);
  EXPECT_EQ(rating(scene.meshes[0], Metric::kDistance), 0.5);
}

TEST(Rate, MetricsThatWereNotAskedForAreNullEverywhere) {
  const AssetAnalysis room =
      asset({geometry(0, 10, 5), geometry(1, 20, 5)}, {instance(0, 0), instance(1, 5)});
  Options options;
  options.metrics.reset().set(index_of(Metric::kRelativeDensity));
  const SceneRating scene = rate(std::span(&room, 1), options);
  EXPECT_TRUE(scene.signed_aggregate);
  for (const MeshRating& mesh : scene.meshes)
    for (std::size_t i = 0; i < analysis::kMetricCount; ++i) {
      EXPECT_EQ(mesh.ratings[i].has_value(), i == index_of(Metric::kRelativeDensity));
      EXPECT_EQ(mesh.relative_ratings[i].has_value(), i == index_of(Metric::kRelativeDensity));
    }
  EXPECT_NEAR(*scene.meshes[0].aggregate, -0.5, 1e-9);  // alone: signed
  EXPECT_NEAR(*scene.meshes[1].aggregate, 0.5, 1e-9);
  EXPECT_TRUE(scene.meshes[0].distance);  // a fact, not a rating
}

TEST(Rate, PassesAFourierRatingOn) {
  AssetAnalysis room = asset({geometry(0, 10, 5), geometry(1, 10, 5)}, {instance(0, 0), instance(1, 0)});
  room.geometries[0].fourier_transform = 0.2;
  room.geometries[1].fourier_transform = 0.6;
  Options options;
  options.relative = true;
  options.weights = {0, 0, 0, 0, 0, 1, 0};
  const SceneRating scene = rate(std::span(&room, 1), options);
  EXPECT_EQ(rating(scene.meshes[1], Metric::kFourierTransform), 0.6);
  EXPECT_EQ(scene.meshes[1].relative_ratings[index_of(Metric::kFourierTransform)], 1);
  EXPECT_EQ(scene.meshes[0].aggregate, 0);
  EXPECT_FALSE(scene.signed_aggregate);
}

TEST(Rate, AFourierRatingIsWeighedLikeTheOthers) {
  AssetAnalysis room = asset({geometry(0, 10, 5), geometry(1, 10, 5)}, {instance(0, 0), instance(1, 0)});
  room.geometries[0].fourier_transform = 0.25;  // of the second mesh it was not computed
  Options options;
  options.weights = {1, 0, 0, 0, 0, 3, 0};
  const SceneRating scene = rate(std::span(&room, 1), options);
  EXPECT_EQ(scene.meshes[0].aggregate, 0.25);
  EXPECT_EQ(scene.meshes[1].aggregate, 0.25) << "a null rating leaves both sums";
  room.geometries[0].fourier_transform = 0.65;
  EXPECT_DOUBLE_EQ(*rate(std::span(&room, 1), options).meshes[0].aggregate, (0.25 + 3 * 0.65) / 4);
  options.weights = {0, 0, 1, 0, 0, 1, 0};
  const SceneRating with_density = rate(std::span(&room, 1), options);
  EXPECT_FALSE(with_density.signed_aggregate) << "density does not stand alone beside it";
}

TEST(Rate, AFourierRatingThatIsNotAskedForOrNoNumberIsNull) {
  AssetAnalysis room = asset({geometry(0, 10, 5), geometry(1, 0, 0)}, {instance(0, 0), instance(1, 0)});
  room.geometries[0].fourier_transform = 0.5;
  room.geometries[1].fourier_transform = 0.5;  // a mesh without triangles has no rating
  Options options;
  EXPECT_EQ(rating(rate(std::span(&room, 1), options).meshes[0], Metric::kFourierTransform), 0.5);
  EXPECT_EQ(rating(rate(std::span(&room, 1), options).meshes[1], Metric::kFourierTransform), std::nullopt);
  options.metrics.reset(index_of(Metric::kFourierTransform));
  EXPECT_EQ(rating(rate(std::span(&room, 1), options).meshes[0], Metric::kFourierTransform), std::nullopt);
  room.geometries[0].fourier_transform = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(rating(rate(std::span(&room, 1), {}).meshes[0], Metric::kFourierTransform), std::nullopt);
}

TEST(Rate, NumbersThatOverflowBecomeNullAndDisturbNobody) {
  AssetAnalysis room = asset({geometry(0, 10, 5), geometry(1, 20, 5)},
                             {instance(0, 0), instance(1, 2), instance(0, 4, 0), instance(0, 5, kInfinity),
                              instance(0, 6, std::numeric_limits<double>::quiet_NaN())});
  room.instances[2].bounds = Bounds{{0, 0, 0}, {kInfinity, 1, 1}};
  const SceneRating scene = rate(std::span(&room, 1), {});
  for (std::size_t i = 2; i < 5; ++i) {
    EXPECT_EQ(scene.meshes[i].density, std::nullopt) << i;
    EXPECT_EQ(rating(scene.meshes[i], Metric::kRelativeDensity), std::nullopt) << i;
    EXPECT_EQ(rating(scene.meshes[i], Metric::kPolygonsPerPlanarGroup), 0.25) << i;
    EXPECT_TRUE(std::isfinite(*scene.meshes[i].aggregate)) << i;
  }
  EXPECT_EQ(scene.meshes[2].distance, std::nullopt);
  EXPECT_EQ(*scene.density_mean, 3);
  EXPECT_EQ(scene.bounds->max[0], 7);
  EXPECT_NEAR(*rating(scene.meshes[0], Metric::kRelativeDensity), -0.5, 1e-9);
}

TEST(Rate, RatingsThatAreNotFiniteAreNull) {
  AssetAnalysis room = asset({geometry(0, 10, 5)}, {instance(0, 0)});
  room.geometries[0].cooccurrence_contrast = std::numeric_limits<double>::quiet_NaN();
  const SceneRating scene = rate(std::span(&room, 1), {});
  EXPECT_EQ(rating(scene.meshes[0], Metric::kCooccurrenceContrast), std::nullopt);
  EXPECT_TRUE(std::isfinite(*scene.meshes[0].aggregate));
}

TEST(Rate, RefusesAnInstanceOfNoGeometry) {
  const AssetAnalysis broken = asset({}, {instance(0, 0)});
  EXPECT_THROW(rate(std::span(&broken, 1), {}), std::out_of_range);
}

TEST(Rate, CostsTheSamePerMeshForAMillion) {
  const auto seconds_for = [](std::size_t count) {
    AssetAnalysis room = asset({geometry(0, 10, 5), geometry(1, 20, 7)}, {});
    for (std::size_t i = 0; i < count; ++i)
      room.instances.push_back(instance(i % 2, static_cast<double>(i), 1 + static_cast<double>(i % 7)));
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(rate(std::span(&room, 1), {}).meshes.size(), count);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const double small = seconds_for(100'000);
  const double large = seconds_for(1'000'000);
  std::printf("100000 meshes %.3f s, 1000000 meshes %.3f s\n", small, large);
  EXPECT_LT(large, 50 * small + 1);  // linear is 10; a quadratic step would be 100
}

}  // namespace
}  // namespace scene_analyzer::ratings
