// library_times.h — Rendering times of many assets: on which device all of them were timed. Inside this room
// only.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "analysis/analysis.h"

namespace scene_analyzer::library {

// Of the asset's timings keeps the first on that kind of device; none without one. Devices of one kind
// measure alike: which of several equal graphics cards it was does not count, and `kind` has no id.
// Processors of the same name are told apart by their number of threads.
void keep_times(analysis::AssetAnalysis& analysis,
                const std::optional<analysis::RenderTiming::Conditions>& kind);

// Takes the times of asset after asset, in one pass.
class LibraryTimes {
 public:
  using Conditions = analysis::RenderTiming::Conditions;

  // Of several timings of an asset keeps one, on the kind of device that all had in common so far where it
  // has that. `first_mesh` is the caller's.
  void take(std::uint32_t asset, std::size_t first_mesh, analysis::AssetAnalysis& analysis);

  bool any() const { return !taken_.empty(); }
  // The kind of device that all assets with times were timed on; of several the one that was met first.
  std::optional<Conditions> common() const;
  // Assets that kept another kind, and their first_mesh. None where nothing is common.
  std::vector<std::pair<std::uint32_t, std::size_t>> to_take_again() const;
  // How many devices of the common kind have timed; 0 without one.
  std::uint32_t devices() const;

 private:
  static constexpr std::size_t kMostKinds = 64;  // more are not told apart, and count as nothing in common
  using Kinds = std::bitset<kMostKinds>;
  struct Taken {
    std::uint32_t asset;
    std::uint32_t kind;
    std::size_t first_mesh;
  };

  std::optional<std::size_t> number_of(const Conditions& kind);
  std::optional<std::size_t> first_common() const;

  std::vector<Conditions> kinds_;
  std::vector<std::set<std::string>> ids_;  // per kind, of the first device of it that each asset has
  Kinds common_ = Kinds().set();
  std::vector<Taken> taken_;
};

}  // namespace scene_analyzer::library
