#include "library/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

#include "analysis_file/analysis_file.h"
#include "base/error.h"
#include "library/journal.h"
#include "library/library_times.h"
#include "library/load_record.h"

namespace scene_analyzer::library {
namespace {

namespace fs = std::filesystem;
using analysis::AssetAnalysis;
using analysis::Metric;

constexpr std::size_t kMostLines = 10;  // of what is missing

std::optional<double> time_of(const ratings::MeshRating& mesh) {
  return mesh.rendering_time && mesh.rendering_time->mean_ns > 0 ? std::optional(mesh.rendering_time->mean_ns)
                                                                 : std::nullopt;
}

bool is_rated(const analysis::GeometryAnalysis& geometry) {
  return geometry.not_analysed.empty() && geometry.triangles > 0;
}

class Merger {
 public:
  Merger(const fs::path& folder, const MergeOptions& options, std::vector<std::string>& warnings)
      : folder_(folder), options_(options), warnings_(warnings) {}

  Merged run(const MergeProgress& progress) {
    Manifest manifest = read_manifest(folder_);
    Journals journals = read_journals(folder_, manifest.shard_count);
    warnings_.insert(warnings_.end(), journals.warnings.begin(), journals.warnings.end());
    const auto assets = std::exchange(manifest.assets, {});
    const auto shards = std::exchange(manifest.shards, {});
    merged_.manifest = std::move(manifest);
    options_.ratings.metrics &= merged_.manifest.metrics;
    options_.ratings.metrics.reset(index_of(Metric::kDistance));
    for (std::size_t i = 0; i < assets.size(); ++i) {
      const auto record = journals.records.extract(assets[i].path);
      if (record.empty())
        miss(assets[i].path, shards[i], "");
      else if (record.mapped().bytes != assets[i].bytes)
        miss(assets[i].path, shards[i],
             fmt::format("{}: has changed since it was looked at", assets[i].path));
      else
        add(std::move(record.mapped()), shards[i]);
      if (progress) progress(i + 1, assets.size());
    }
    refuse_what_is_missing(assets.size());
    rate();
    collect_duplicates();
    return std::move(merged_);
  }

 private:
  void miss(const std::string& asset, std::uint32_t shard, const std::string& reason) {
    merged_.missing.push_back(asset);
    ++missing_of_shard_[shard];
    if (!reason.empty()) reasons_.push_back(reason);
  }

  void add(Record record, std::uint32_t shard) {
    record.warnings = {};
    if (record.status != Status::kAnalysed) {
      merged_.not_analysed.push_back(std::move(record));
      return;
    }
    auto loaded = load_record(folder_, record, merged_.manifest);
    if (const auto* reason = std::get_if<std::string>(&loaded)) return miss(record.asset, shard, *reason);
    auto& analysis = std::get<AssetAnalysis>(loaded);
    const auto asset = static_cast<std::uint32_t>(merged_.assets.size());
    merged_.bytes += record.bytes;
    merged_.assets.push_back(std::move(record));
    times_.take(asset, merged_.meshes.size(), analysis);
    add_meshes(asset, analysis);
    add_geometries(asset, analysis);
  }

  // What an asset's ratings are without the others; those that need them are replaced by rate().
  void add_meshes(std::uint32_t asset, const AssetAnalysis& analysis) {
    const ratings::SceneRating alone = ratings::rate(std::span(&analysis, 1), options_.ratings);
    merged_.unique_triangles += alone.unique_triangles;
    merged_.drawn_triangles += alone.drawn_triangles;
    merged_.degenerate_triangles += alone.degenerate_triangles;
    for (const ratings::MeshRating& rated : alone.meshes) {
      const auto& instance = analysis.instances[rated.instance];
      const MergedMesh mesh{.asset = asset,
                            .instance = static_cast<std::uint32_t>(rated.instance),
                            .triangles = analysis.geometries[instance.geometry].triangles,
                            .shape_hash = analysis.geometries[instance.geometry].shape_hash.value_or(
                                std::array<std::uint64_t, 2>()),
                            .density = rated.density,
                            .time_ns = time_of(rated)};
      merged_.meshes.push_back(mesh);
      merged_.ratings.push_back(rated.ratings);
    }
  }

  void add_geometries(std::uint32_t asset, const AssetAnalysis& analysis) {
    for (const auto& geometry : analysis.geometries) {
      if (geometry.defects)
        for (const auto& found : geometry.defects->found) {
          DefectTotals& totals = merged_.defects[index_of(found.defect)];
          ++totals.meshes;
          totals.count += found.count;
        }
      if (is_rated(geometry) && geometry.shape_hash)
        shapes_.push_back({*geometry.shape_hash, geometry.source_triangles, asset});
    }
  }

  void refuse_what_is_missing(std::size_t assets) {
    if (merged_.missing.empty() || options_.allow_missing) return;
    std::vector<std::string> lines;
    for (const auto& [shard, count] : missing_of_shard_)
      lines.push_back(fmt::format("shard {} of {}: {} not analysed yet", shard, merged_.manifest.shard_count,
                                  count == 1 ? "1 asset is" : fmt::format("{} assets are", count)));
    lines.insert(lines.end(), reasons_.begin(), reasons_.end());
    for (const std::string& asset : merged_.missing) lines.push_back("missing: " + asset);
    const std::size_t left_out = lines.size() > kMostLines ? lines.size() - kMostLines : 0;
    lines.resize(lines.size() - left_out);
    if (left_out > 0) lines.push_back(fmt::format("and {} more lines like these", left_out));
    throw Incomplete(
        fmt::format("{} of {} assets are missing: run batch again, for the shards named, or merge "
                    "what is there with --allow-missing",
                    merged_.missing.size(), assets),
        std::move(lines));
  }

  // Rates those meshes that have the fact, against each other.
  void rate_against_each_other(std::optional<double> MergedMesh::*fact, Metric metric,
                               std::vector<double> (*rule)(std::span<const double>)) {
    std::vector<double> values;
    std::vector<std::size_t> owners;
    for (std::size_t i = 0; i < merged_.meshes.size(); ++i) {
      merged_.ratings[i][index_of(metric)].reset();
      if (!(merged_.meshes[i].*fact)) continue;
      values.push_back(*(merged_.meshes[i].*fact));
      owners.push_back(i);
    }
    if (!options_.ratings.metrics[index_of(metric)]) return;
    const std::vector<double> rated = rule(values);
    for (std::size_t k = 0; k < owners.size(); ++k) merged_.ratings[owners[k]][index_of(metric)] = rated[k];
  }

  // What the first pass has taken may be of another device than the one that all have in common.
  void settle_times() {
    merged_.timing = times_.common();
    merged_.mixed_timings = times_.any() && !merged_.timing;
    if (merged_.mixed_timings)
      for (MergedMesh& mesh : merged_.meshes) mesh.time_ns.reset();
    for (const auto& [asset, first_mesh] : times_.to_take_again()) {
      const AssetAnalysis analysis = load_merged(folder_, merged_, asset);
      const ratings::SceneRating alone = ratings::rate(std::span(&analysis, 1), options_.ratings);
      for (std::size_t i = 0; i < alone.meshes.size(); ++i)
        merged_.meshes[first_mesh + i].time_ns = time_of(alone.meshes[i]);
    }
    merged_.timing_devices = times_.devices();
  }

  void rate() {
    settle_times();
    rate_against_each_other(&MergedMesh::density, Metric::kRelativeDensity, ratings::relative_densities);
    rate_against_each_other(&MergedMesh::time_ns, Metric::kRenderingTime, ratings::rendering_time_ratings);
    merged_.relative_ratings = ratings::relative_ratings(merged_.ratings);
    merged_.aggregates = ratings::aggregates(merged_.ratings, options_.ratings);
    merged_.signed_aggregate = ratings::density_stands_alone(merged_.ratings, options_.ratings.weights);
    std::vector<double> densities;
    for (const MergedMesh& mesh : merged_.meshes)
      if (mesh.density) densities.push_back(*mesh.density);
    if (densities.empty()) return;
    const auto statistics = ratings::density_statistics(densities);
    merged_.density_mean = statistics.mean;
    merged_.density_deviation = statistics.deviation;
  }

  // A geometry of an asset that may stand in others, too.
  struct Shape {
    std::array<std::uint64_t, 2> hash;
    std::uint64_t triangles;
    std::uint32_t asset;
    auto operator<=>(const Shape&) const = default;
  };

  void collect_duplicates() {
    std::ranges::sort(shapes_);
    for (std::size_t begin = 0, end = 0; begin < shapes_.size(); begin = end) {
      Duplicate shape{.shape_hash = shapes_[begin].hash, .triangles = shapes_[begin].triangles, .assets = {}};
      for (end = begin; end < shapes_.size() && shapes_[end].hash == shape.shape_hash; ++end)
        if (shape.assets.empty() || shape.assets.back() != shapes_[end].asset)
          shape.assets.push_back(shapes_[end].asset);
      if (shape.assets.size() > 1) merged_.duplicates.push_back(std::move(shape));
    }
    std::ranges::stable_sort(merged_.duplicates, std::greater<>(), &Duplicate::redundant_triangles);
  }

  const fs::path& folder_;
  MergeOptions options_;
  std::vector<std::string>& warnings_;
  Merged merged_;
  std::map<std::uint32_t, std::uint64_t> missing_of_shard_;
  std::vector<std::string> reasons_;
  LibraryTimes times_;
  std::vector<Shape> shapes_;
};

}  // namespace

Merged merge(const fs::path& folder, const MergeOptions& options, std::vector<std::string>& warnings,
             const MergeProgress& progress) {
  return Merger(folder, options, warnings).run(progress);
}

}  // namespace scene_analyzer::library
