#include "rpc/messages.h"

#include <fmt/format.h>

#include <stdexcept>
#include <variant>

#include "analysis_file/codec.h"
#include "base/version.h"
#include "service/refusal.h"

namespace scene_analyzer::rpc {
namespace {

constexpr int kMostTimings = 64;  // of one asset, as analysis files have

void set_point(const mesh::Vector3& point, v1::Vector3& message) {
  message.set_x(point[0]);
  message.set_y(point[1]);
  message.set_z(point[2]);
}

void set_ratings(const ratings::OptionalRatings& values, v1::Ratings& message) {
  using analysis::Metric;
  const auto set = [&](Metric metric, void (v1::Ratings::*setter)(double)) {
    if (const auto& value = values[index_of(metric)]) (message.*setter)(*value);
  };
  set(Metric::kPolygonsPerPlanarGroup, &v1::Ratings::set_polygons_per_planar_group);
  set(Metric::kPlanarGroupVariation, &v1::Ratings::set_planar_group_variation);
  set(Metric::kRelativeDensity, &v1::Ratings::set_relative_density);
  set(Metric::kDistance, &v1::Ratings::set_distance);
  set(Metric::kCooccurrenceContrast, &v1::Ratings::set_cooccurrence_contrast);
  set(Metric::kFourierTransform, &v1::Ratings::set_fourier_transform);
  set(Metric::kRenderingTime, &v1::Ratings::set_rendering_time);
}

void set_mesh(const ratings::MeshRating& mesh, v1::MeshRating& message) {
  message.set_asset(static_cast<std::uint32_t>(mesh.asset));
  message.set_instance(static_cast<std::uint32_t>(mesh.instance));
  message.set_surface_area(mesh.surface_area);
  if (mesh.density) message.set_density(*mesh.density);
  if (mesh.distance) message.set_distance(*mesh.distance);
  if (mesh.rendering_time && mesh.rendering_time->mean_ns > 0)
    message.set_rendering_time_ns(mesh.rendering_time->mean_ns);
  set_ratings(mesh.ratings, *message.mutable_ratings());
  set_ratings(mesh.relative_ratings, *message.mutable_relative_ratings());
  if (mesh.aggregate) message.set_aggregate(*mesh.aggregate);
}

}  // namespace

v1::Analysis to_message(const analysis::AssetAnalysis& analysis) {
  v1::Analysis message;
  if (!message.ParseFromString(analysis_file::encode(analysis, version())))
    throw std::logic_error("an analysis that was just encoded cannot be parsed");
  return message;
}

analysis::AssetAnalysis from_message(const v1::Analysis& message, const std::string& where) {
  if (message.render_timings_size() > kMostTimings)
    throw service::Refusal(service::Reason::kInvalid,
                           fmt::format("{}: has more than {} render_timings", where, kMostTimings));
  auto decoded = analysis_file::decode(message.SerializeAsString());
  if (const auto* unusable = std::get_if<analysis_file::Unusable>(&decoded))
    throw service::Refusal(service::Reason::kInvalid, fmt::format("{}: {}", where, unusable->reason));
  return std::move(std::get<analysis_file::Stored>(decoded).analysis);
}

v1::RateResponse to_message(const ratings::SceneRating& rating) {
  v1::RateResponse message;
  for (const ratings::MeshRating& mesh : rating.meshes) set_mesh(mesh, *message.add_meshes());
  message.set_unique_triangles(rating.unique_triangles);
  message.set_drawn_triangles(rating.drawn_triangles);
  message.set_degenerate_triangles(rating.degenerate_triangles);
  if (rating.bounds) {
    for (const double coordinate : rating.bounds->min) message.mutable_bounds()->add_min(coordinate);
    for (const double coordinate : rating.bounds->max) message.mutable_bounds()->add_max(coordinate);
  }
  if (rating.eye) set_point(*rating.eye, *message.mutable_eye());
  if (rating.density_mean) message.set_density_mean(*rating.density_mean);
  if (rating.density_deviation) message.set_density_deviation(*rating.density_deviation);
  message.set_signed_aggregate(rating.signed_aggregate);
  message.set_mixed_timings(rating.mixed_timings);
  return message;
}

v1::Device to_message(const gpu::DeviceInfo& device, bool in_use) {
  v1::Device message;
  message.set_index(device.index);
  message.set_name(device.name);
  message.set_type(gpu::to_string(device.type));
  message.set_driver(device.driver);
  message.set_api_version(device.api_version);
  message.set_memory_bytes(device.memory_bytes);
  message.set_max_storage_buffer_bytes(device.max_storage_buffer_bytes);
  message.set_can_draw(device.can_draw);
  message.set_in_use(in_use);
  for (const std::string& refusal : device.refusals) message.add_refusals(refusal);
  return message;
}

}  // namespace scene_analyzer::rpc
