// shards.h — Which part of a library one task of many analyses.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "library/asset_list.h"

namespace scene_analyzer::library {

struct Shard {
  std::uint32_t index = 0;  // < count
  std::uint32_t count = 1;
  bool operator==(const Shard&) const = default;
};

inline constexpr std::uint32_t kMostShards = 1'000'000;

// The value of an environment variable; nothing where it is not set.
using Environment = std::function<std::optional<std::string>(const char* name)>;

// The shard that a scheduler's variables name, tried in this order:
// - Slurm's job arrays: SLURM_ARRAY_TASK_ID, _MIN, _STEP (default 1) and _COUNT; indices need not begin at 0;
// - Kubernetes' Indexed Jobs: JOB_COMPLETION_INDEX, and SHARD_COUNT, which the job's author sets to its
//   completions, as Kubernetes does not pass them on;
// - GTEST_SHARD_INDEX and GTEST_TOTAL_SHARDS, which other schedulers of tests set.
// Throws UsageError when none of them is there, when one lacks its other half, and when they contradict each
// other.
Shard shard_from_environment(const Environment& environment);

// The shard of each asset, in their order: the same on every machine that lists the same assets. The largest
// assets are dealt first, each to the shard that has least so far, in bytes and in what every asset costs
// whatever its size. Cost: n log n in assets, n log m in shards.
std::vector<std::uint32_t> assign_shards(std::span<const ListedAsset> assets, std::uint32_t count);

}  // namespace scene_analyzer::library
