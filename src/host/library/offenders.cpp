// offenders.cpp — Which meshes of a library are the worst.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "library/load_record.h"
#include "library/merge.h"

namespace scene_analyzer::library {
namespace {

using analysis::kMetricCount;

std::optional<double> value_of(const Merged& merged, std::size_t mesh, std::size_t rating) {
  return rating == kMetricCount ? merged.aggregates[mesh] : merged.ratings[mesh][rating];
}

std::vector<Offender> largest(const Merged& merged, std::size_t rating, std::size_t count) {
  std::vector<std::pair<double, std::size_t>> order;  // largest magnitude first, then as in the library
  for (std::size_t mesh = 0; mesh < merged.meshes.size(); ++mesh)
    if (const auto value = value_of(merged, mesh, rating)) order.emplace_back(-std::abs(*value), mesh);
  std::ranges::sort(order);
  std::vector<Offender> offenders;
  std::map<std::pair<double, std::array<std::uint64_t, 2>>, std::size_t> listed;
  for (const auto& [rank, mesh] : order) {
    const double value = *value_of(merged, mesh, rating);
    const auto known = listed.find({value, merged.meshes[mesh].shape_hash});
    if (known != listed.end()) {
      ++offenders[known->second].others;
    } else if (offenders.size() < count) {
      listed.emplace(std::pair(value, merged.meshes[mesh].shape_hash), offenders.size());
      offenders.push_back({.mesh = mesh, .value = value, .others = 0, .node = {}, .name = {}});
    } else if (offenders.empty() || rank > -std::abs(offenders.back().value)) {
      break;  // no more of the same value
    }
  }
  return offenders;
}

// In the order of assets, so that each analysis file is read once.
void add_names(const std::filesystem::path& folder, const Merged& merged, Offenders& all,
               const std::function<void()>& check) {
  std::vector<Offender*> offenders;
  for (auto& of_rating : all)
    for (Offender& offender : of_rating) offenders.push_back(&offender);
  std::ranges::sort(offenders, {}, &Offender::mesh);
  std::optional<std::uint32_t> asset;
  analysis::AssetAnalysis analysis;
  for (Offender* offender : offenders) {
    const MergedMesh& mesh = merged.meshes[offender->mesh];
    if (mesh.asset != asset) {
      if (check) check();
      analysis = load_merged(folder, merged, mesh.asset);
      asset = mesh.asset;
    }
    const auto& instance = analysis.instances.at(mesh.instance);
    offender->node = instance.node;
    offender->name = instance.mesh;
  }
}

}  // namespace

Offenders top_offenders(const std::filesystem::path& folder, const Merged& merged, std::size_t count,
                        const std::function<void()>& check) {
  Offenders offenders;
  for (std::size_t rating = 0; rating <= kMetricCount; ++rating)
    offenders[rating] = largest(merged, rating, count);
  add_names(folder, merged, offenders, check);
  return offenders;
}

}  // namespace scene_analyzer::library
