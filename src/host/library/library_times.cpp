#include "library/library_times.h"

#include <algorithm>

namespace scene_analyzer::library {

using analysis::AssetAnalysis;
using analysis::RenderTiming;

namespace {

RenderTiming::Conditions kind_of(RenderTiming::Conditions conditions) {
  if (conditions.device.type != "cpu") conditions.device.id.clear();
  return conditions;
}

}  // namespace

void keep_times(AssetAnalysis& analysis, const std::optional<RenderTiming::Conditions>& kind) {
  std::erase_if(analysis.timings,
                [&](const RenderTiming& timing) { return kind_of(timing.conditions) != kind; });
  if (!analysis.timings.empty()) analysis.timings.resize(1);
}

std::optional<std::size_t> LibraryTimes::number_of(const Conditions& kind) {
  const auto known = std::ranges::find(kinds_, kind);
  if (known != kinds_.end()) return static_cast<std::size_t>(known - kinds_.begin());
  if (kinds_.size() == kMostKinds) return std::nullopt;
  kinds_.push_back(kind);
  ids_.emplace_back();
  return kinds_.size() - 1;
}

std::optional<std::size_t> LibraryTimes::first_common() const {
  for (std::size_t kind = 0; kind < kinds_.size(); ++kind)
    if (common_[kind]) return kind;
  return std::nullopt;
}

void LibraryTimes::take(std::uint32_t asset, std::size_t first_mesh, AssetAnalysis& analysis) {
  if (analysis.timings.empty()) return;
  Kinds kinds;
  std::optional<std::size_t> first;
  for (const RenderTiming& timing : analysis.timings) {
    const auto kind = number_of(kind_of(timing.conditions));
    if (!kind) continue;
    if (!kinds[*kind]) ids_[*kind].insert(timing.conditions.device.id);
    kinds.set(*kind);
    if (!first) first = kind;
  }
  common_ &= kinds;
  if (!first) return analysis.timings.clear();
  const std::size_t kept = first_common().value_or(*first);
  taken_.push_back({asset, static_cast<std::uint32_t>(kept), first_mesh});
  keep_times(analysis, kinds_[kept]);
}

std::uint32_t LibraryTimes::devices() const {
  const auto kind = first_common();
  return kind ? static_cast<std::uint32_t>(ids_[*kind].size()) : 0;
}

std::optional<LibraryTimes::Conditions> LibraryTimes::common() const {
  const auto kind = first_common();
  return kind ? std::optional(kinds_[*kind]) : std::nullopt;
}

std::vector<std::pair<std::uint32_t, std::size_t>> LibraryTimes::to_take_again() const {
  std::vector<std::pair<std::uint32_t, std::size_t>> others;
  if (const auto kind = first_common())
    for (const Taken& taken : taken_)
      if (taken.kind != *kind) others.emplace_back(taken.asset, taken.first_mesh);
  return others;
}

}  // namespace scene_analyzer::library
