#include "analysis_file/codec.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <bit>
#include <span>

#include "analysis_file/envelope.h"
#include "base/error.h"
#include "scene_analyzer/v1/analysis.pb.h"

namespace scene_analyzer::analysis_file {
namespace {

// By bits: a matrix of negative zeros is not the identity when a round trip has to be exact.
bool same_bits(std::span<const double> a, std::span<const double> b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  return true;
}

void write_parameters(const analysis::Parameters& from, v1::Parameters& to) {
  to.set_alpha_degrees(from.alpha_degrees);
  to.set_dim(from.dim);
  to.set_weld_tolerance(from.weld_tolerance);
  to.set_steps(from.steps);
  to.set_start_searches(from.start_searches);
}

void write_file(const analysis::FileFingerprint& from, v1::File& to) {
  to.set_path(from.path);
  to.set_found(from.found);
  to.set_size(from.size);
  to.set_hash_low(from.hash[0]);
  to.set_hash_high(from.hash[1]);
}

void write_signal(const analysis::SignalSummary& from, v1::Signal& to) {
  to.set_length(from.length);
  to.set_start_triangle(from.start_triangle);
  to.set_mean_distance(from.mean_distance);
  to.set_gap(from.gap);
  to.set_searches(from.searches);
}

void write_defects(const analysis::Defects& from, v1::Defects& to) {
  for (const analysis::FoundDefect& one : from.found) {
    v1::Defect& defect = *to.add_found();
    defect.set_kind(static_cast<v1::Defect::Kind>(one.defect));
    defect.set_count(one.count);
    defect.mutable_places()->Add(one.places.begin(), one.places.end());
  }
}

void write_geometry(const analysis::GeometryAnalysis& from, v1::Geometry& to) {
  to.set_mesh(from.mesh);
  if (!same_bits(from.linear, mesh::kIdentity3))
    to.mutable_linear()->Add(from.linear.begin(), from.linear.end());
  if (from.shape_hash) {
    to.set_shape_hash_low((*from.shape_hash)[0]);
    to.set_shape_hash_high((*from.shape_hash)[1]);
  }
  to.set_source_triangles(from.source_triangles);
  to.set_degenerate_triangles(from.degenerate_triangles);
  to.set_triangles(from.triangles);
  to.set_surface_area(from.surface_area);
  if (from.planar_groups) to.set_planar_groups(*from.planar_groups);
  if (from.largest_planar_group) to.set_largest_planar_group(*from.largest_planar_group);
  if (from.components) to.set_components(*from.components);
  if (from.isolated_triangles) to.set_isolated_triangles(*from.isolated_triangles);
  if (from.non_manifold_edges) to.set_non_manifold_edges(*from.non_manifold_edges);
  if (from.boundary_edges) to.set_boundary_edges(*from.boundary_edges);
  if (from.area_classes) to.set_area_classes(*from.area_classes);
  if (from.polygons_per_planar_group) to.set_polygons_per_planar_group(*from.polygons_per_planar_group);
  if (from.planar_group_variation) to.set_planar_group_variation(*from.planar_group_variation);
  if (from.cooccurrence_contrast) to.set_cooccurrence_contrast(*from.cooccurrence_contrast);
  if (from.fourier_transform) to.set_fourier_transform(*from.fourier_transform);
  if (from.signal) write_signal(*from.signal, *to.mutable_signal());
  if (from.defects) write_defects(*from.defects, *to.mutable_defects());
  to.set_not_analysed(from.not_analysed);
}

// A library of small meshes consists of matrices mostly: rows that say nothing are left out.
void write_world(const mesh::Matrix4& world, v1::Instance& to) {
  if (same_bits(world, mesh::kIdentity4)) return;
  const std::span<const double> rows(world);
  const bool affine = same_bits(rows.subspan(12), std::span(mesh::kIdentity4).subspan(12));
  to.mutable_world()->Add(world.begin(), affine ? world.begin() + 12 : world.end());
}

void write_instance(const analysis::InstanceAnalysis& from, v1::Instance& to) {
  to.set_geometry(from.geometry);
  to.set_node(from.node);
  to.set_mesh(from.mesh);
  if (from.area_scale != 1) to.set_area_scale(from.area_scale);
  write_world(from.world, to);
  if (!from.bounds) return;
  v1::Bounds& bounds = *to.mutable_bounds();
  bounds.mutable_min()->Add(from.bounds->min.begin(), from.bounds->min.end());
  bounds.mutable_max()->Add(from.bounds->max.begin(), from.bounds->max.end());
}

void write_time(const analysis::RenderingTime& from, v1::RenderingTime& to) {
  to.set_mean_ns(from.mean_ns);
  if (from.confidence_ns) to.set_confidence_ns(*from.confidence_ns);
  to.set_fastest_ns(from.fastest_ns);
  to.set_slowest_ns(from.slowest_ns);
  to.set_rounds(from.rounds);
  to.set_rotations(from.rotations);
  if (from.vertex_invocations) to.set_vertex_invocations(*from.vertex_invocations);
  if (from.fragment_invocations) to.set_fragment_invocations(*from.fragment_invocations);
  if (from.overdraw) to.set_overdraw(*from.overdraw);
}

void write_timing(const analysis::RenderTiming& from, v1::RenderTiming& to) {
  to.set_device(from.conditions.device.name);
  to.set_driver(from.conditions.device.driver);
  to.set_device_type(from.conditions.device.type);
  to.set_width(from.conditions.width);
  to.set_height(from.conditions.height);
  to.set_steps(from.conditions.steps);
  to.set_timestamp_period_ns(from.timestamp_period_ns);
  to.set_budget_seconds(from.budget_seconds);
  to.set_device_id(from.conditions.device.id);
  for (const auto& time : from.times) write_time(time, *to.add_times());
}

void write_head(const analysis::AssetAnalysis& from, std::string_view version, v1::Analysis& to) {
  to.set_content_key(content_key_of(from, version));
  to.mutable_tool()->set_version(std::string(version));
  to.mutable_tool()->set_device(from.device.name);
  to.mutable_tool()->set_driver(from.device.driver);
  to.mutable_tool()->set_device_type(from.device.type);
  write_parameters(from.parameters, *to.mutable_parameters());
  for (std::size_t i = 0; i < analysis::kMetricCount; ++i)
    if (from.computed[i]) to.add_metrics(std::string(analysis::kMetricKeys[i]));
  to.set_asset(from.asset);
  to.set_format(from.format);
  if (from.unit_scale) to.set_unit_scale(*from.unit_scale);
  if (from.up_axis) to.set_up_axis(*from.up_axis);
}

std::string serialized(const v1::Analysis& message) {
  const std::size_t size = message.ByteSizeLong();
  if (size > kMaxFileBytes - kHeaderBytes - kChecksumBytes)
    throw InputError("the analysis needs " + std::to_string(size) + " bytes, more than the " +
                     std::to_string(kMaxFileBytes) + " that an analysis file can hold");
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream string(&bytes);
    google::protobuf::io::CodedOutputStream coded(&string);
    coded.SetSerializationDeterministic(true);
    message.SerializeWithCachedSizes(&coded);
  }
  if (bytes.size() != size) throw std::runtime_error("the analysis could not be serialised");
  return bytes;
}

}  // namespace

std::string encode(const analysis::AssetAnalysis& analysis, std::string_view version) {
  v1::Analysis message;
  write_head(analysis, version, message);
  for (const auto& file : analysis.files) write_file(file, *message.add_files());
  for (const auto& geometry : analysis.geometries) write_geometry(geometry, *message.add_geometries());
  for (const auto& instance : analysis.instances) write_instance(instance, *message.add_instances());
  for (const auto& warning : analysis.warnings) message.add_warnings(warning);
  for (const auto& timing : analysis.timings) write_timing(timing, *message.add_render_timings());
  return serialized(message);
}

}  // namespace scene_analyzer::analysis_file
