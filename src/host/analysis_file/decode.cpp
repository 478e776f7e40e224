#include <google/protobuf/stubs/logging.h>

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "analysis_file/codec.h"
#include "analysis_file/plausible.h"
#include "scene_analyzer/v1/analysis.pb.h"

namespace scene_analyzer::analysis_file {
namespace {

// Bytes that parse but cannot be an analysis. Never leaves this file.
struct Contradiction : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <typename Values, std::size_t kCount>
void read_numbers(const Values& from, std::array<double, kCount>& to, const char* what) {
  if (static_cast<std::size_t>(from.size()) != kCount)
    throw Contradiction(std::string("wrong number of values in ") + what);
  std::copy(from.begin(), from.end(), to.begin());
}

analysis::Parameters read_parameters(const v1::Parameters& from) {
  return {from.alpha_degrees(), from.dim(), from.weld_tolerance(), from.steps(), from.start_searches()};
}

analysis::MetricSet read_metrics(const v1::Analysis& from) {
  analysis::MetricSet metrics;
  for (const std::string& key : from.metrics()) {
    const auto metric = analysis::metric_of(key);
    if (!metric) throw Contradiction("unknown metric '" + key + "'");
    if (metrics[analysis::index_of(*metric)]) throw Contradiction("metric '" + key + "' twice");
    metrics.set(analysis::index_of(*metric));
  }
  return metrics;
}

// Present -> value, not set -> nothing.
template <typename T>
std::optional<T> when(bool present, T value) {
  return present ? std::optional<T>(value) : std::nullopt;
}

std::optional<std::uint64_t> count_when(bool present, std::uint64_t value) {
  return when(present, value);
}

analysis::SignalSummary read_signal(const v1::Signal& from) {
  return {from.length(), from.start_triangle(), from.mean_distance(), from.gap(), from.searches()};
}

analysis::Defects read_defects(const v1::Defects& from) {
  analysis::Defects to;
  for (const v1::Defect& one : from.found()) {
    if (!v1::Defect::Kind_IsValid(one.kind())) throw Contradiction("an unknown kind of defect");
    to.found.push_back({.defect = static_cast<analysis::Defect>(one.kind()),
                        .count = one.count(),
                        .places = {one.places().begin(), one.places().end()}});
  }
  return to;
}

analysis::GeometryAnalysis read_geometry(const v1::Geometry& from) {
  analysis::GeometryAnalysis to;
  to.mesh = from.mesh();
  if (from.linear_size() != 0) read_numbers(from.linear(), to.linear, "linear");
  if (from.has_shape_hash_low() != from.has_shape_hash_high()) throw Contradiction("half a hash of a shape");
  if (from.has_shape_hash_low()) to.shape_hash = std::array{from.shape_hash_low(), from.shape_hash_high()};
  to.source_triangles = from.source_triangles();
  to.degenerate_triangles = from.degenerate_triangles();
  to.triangles = from.triangles();
  to.surface_area = from.surface_area();
  to.planar_groups = count_when(from.has_planar_groups(), from.planar_groups());
  to.largest_planar_group = count_when(from.has_largest_planar_group(), from.largest_planar_group());
  to.components = count_when(from.has_components(), from.components());
  to.isolated_triangles = count_when(from.has_isolated_triangles(), from.isolated_triangles());
  to.non_manifold_edges = count_when(from.has_non_manifold_edges(), from.non_manifold_edges());
  to.boundary_edges = count_when(from.has_boundary_edges(), from.boundary_edges());
  to.area_classes = count_when(from.has_area_classes(), from.area_classes());
  to.polygons_per_planar_group = when(from.has_polygons_per_planar_group(), from.polygons_per_planar_group());
  to.planar_group_variation = when(from.has_planar_group_variation(), from.planar_group_variation());
  to.cooccurrence_contrast = when(from.has_cooccurrence_contrast(), from.cooccurrence_contrast());
  to.fourier_transform = when(from.has_fourier_transform(), from.fourier_transform());
  if (from.has_signal()) to.signal = read_signal(from.signal());
  if (from.has_defects()) to.defects = read_defects(from.defects());
  to.not_analysed = from.not_analysed();
  return to;
}

analysis::InstanceAnalysis read_instance(const v1::Instance& from) {
  analysis::InstanceAnalysis to;
  to.geometry = from.geometry();
  to.node = from.node();
  to.mesh = from.mesh();
  if (from.has_area_scale()) to.area_scale = from.area_scale();
  if (from.world_size() == 12)
    std::copy(from.world().begin(), from.world().end(), to.world.begin());
  else if (from.world_size() != 0)
    read_numbers(from.world(), to.world, "world");
  if (from.has_bounds()) {
    to.bounds.emplace();
    read_numbers(from.bounds().min(), to.bounds->min, "bounds");
    read_numbers(from.bounds().max(), to.bounds->max, "bounds");
  }
  return to;
}

analysis::RenderingTime read_time(const v1::RenderingTime& from) {
  analysis::RenderingTime to;
  to.mean_ns = from.mean_ns();
  to.confidence_ns = when(from.has_confidence_ns(), from.confidence_ns());
  to.fastest_ns = from.fastest_ns();
  to.slowest_ns = from.slowest_ns();
  to.rounds = from.rounds();
  to.rotations = from.rotations();
  to.vertex_invocations = when(from.has_vertex_invocations(), from.vertex_invocations());
  to.fragment_invocations = when(from.has_fragment_invocations(), from.fragment_invocations());
  to.overdraw = when(from.has_overdraw(), from.overdraw());
  return to;
}

analysis::RenderTiming read_timing(const v1::RenderTiming& from) {
  analysis::RenderTiming to;
  to.conditions = {
      {from.device(), from.driver(), from.device_type()}, from.width(), from.height(), from.steps()};
  to.timestamp_period_ns = from.timestamp_period_ns();
  to.budget_seconds = from.budget_seconds();
  to.conditions.device.id = from.device_id();
  for (const auto& time : from.times()) to.times.push_back(read_time(time));
  return to;
}

analysis::FileFingerprint read_file(const v1::File& from) {
  return {from.path(), from.found(), from.size(), {from.hash_low(), from.hash_high()}};
}

Stored read_message(const v1::Analysis& from) {
  Stored stored;
  stored.version = from.tool().version();
  analysis::AssetAnalysis& to = stored.analysis;
  to.asset = from.asset();
  to.format = from.format();
  to.unit_scale = when(from.has_unit_scale(), from.unit_scale());
  if (from.has_up_axis()) to.up_axis = from.up_axis();
  to.parameters = read_parameters(from.parameters());
  to.computed = read_metrics(from);
  to.device = {from.tool().device(), from.tool().driver(), from.tool().device_type()};
  to.geometries.reserve(static_cast<std::size_t>(from.geometries_size()));
  for (const auto& geometry : from.geometries()) to.geometries.push_back(read_geometry(geometry));
  to.instances.reserve(static_cast<std::size_t>(from.instances_size()));
  for (const auto& instance : from.instances()) to.instances.push_back(read_instance(instance));
  for (const auto& file : from.files()) to.files.push_back(read_file(file));
  to.warnings.assign(from.warnings().begin(), from.warnings().end());
  for (const auto& timing : from.render_timings()) to.timings.push_back(read_timing(timing));
  return stored;
}

}  // namespace

std::variant<Stored, Unusable> decode(std::string_view payload) {
  v1::Analysis message;
  // It tells standard error what it dislikes; users get one sentence, ours.
  const google::protobuf::LogSilencer silencer;
  if (!message.ParseFromArray(payload.data(), static_cast<int>(payload.size())))
    return Unusable{false, "is corrupt: its contents cannot be parsed"};
  try {
    Stored stored = read_message(message);
    if (stored.version.empty()) throw Contradiction("no program version");
    if (const auto reason = implausible(stored.analysis)) throw Contradiction(*reason);
    if (message.content_key() != content_key_of(stored.analysis, stored.version))
      throw Contradiction("the content key does not belong to the contents");
    return stored;
  } catch (const Contradiction& contradiction) {
    return Unusable{false, std::string("contradicts itself: ") + contradiction.what()};
  }
}

}  // namespace scene_analyzer::analysis_file
