#include "library/shards.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

#include "base/error.h"

namespace scene_analyzer::library {
namespace {

// About what an asset without anything in it takes, in bytes of one with something in it.
constexpr std::uint64_t kBytesPerAsset = 64 << 10;

std::uint64_t number_in(const Environment& environment, const char* name) {
  const auto text = environment(name);
  if (!text) throw UsageError(fmt::format("--shard auto: {} is not set; see --help", name));
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), number);
  if (error != std::errc() || end != text->data() + text->size() || text->empty())
    throw UsageError(fmt::format("--shard auto: {}='{}' is no whole number", name, *text));
  return number;
}

Shard checked(std::uint64_t index, std::uint64_t count, const char* index_name, const char* count_name) {
  if (count == 0 || count > kMostShards)
    throw UsageError(
        fmt::format("--shard auto: {}={}; from 1 to {} shards are possible", count_name, count, kMostShards));
  if (index >= count)
    throw UsageError(fmt::format("--shard auto: {} says shard {} (from 0), but {} says that there are {}",
                                 index_name, index, count_name, count));
  return {static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(count)};
}

// With gaps (--array=1,2,6) the numbers do not say which shard a task is, also where this one's seems to.
void refuse_gaps(const Environment& environment, std::uint64_t least, std::uint64_t step) {
  const std::uint64_t most = number_in(environment, "SLURM_ARRAY_TASK_MAX");
  const std::uint64_t count = number_in(environment, "SLURM_ARRAY_TASK_COUNT");
  if (most >= least && (most - least) / step + 1 == count) return;
  throw UsageError(fmt::format(
      "--shard auto: an array of {} tasks from SLURM_ARRAY_TASK_MIN={} to SLURM_ARRAY_TASK_MAX={} "
      "in steps of {} has gaps; arrays of single numbers (--array=1,5,6) need --shard-index and "
      "--shard-count",
      count, least, most, step));
}

Shard slurm_shard(const Environment& environment) {
  const std::uint64_t task = number_in(environment, "SLURM_ARRAY_TASK_ID");
  const std::uint64_t least = number_in(environment, "SLURM_ARRAY_TASK_MIN");
  const std::uint64_t step =
      environment("SLURM_ARRAY_TASK_STEP") ? number_in(environment, "SLURM_ARRAY_TASK_STEP") : 1;
  if (step == 0 || task < least || (task - least) % step != 0)
    throw UsageError(
        fmt::format("--shard auto: SLURM_ARRAY_TASK_ID={} is none of the array that begins at "
                    "SLURM_ARRAY_TASK_MIN={} in steps of SLURM_ARRAY_TASK_STEP={}; arrays of single numbers "
                    "(--array=1,5,6) need --shard-index and --shard-count",
                    task, least, step));
  if (environment("SLURM_ARRAY_TASK_MAX")) refuse_gaps(environment, least, step);
  return checked((task - least) / step, number_in(environment, "SLURM_ARRAY_TASK_COUNT"),
                 "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT");
}

Shard pair_of(const Environment& environment, const char* index, const char* count) {
  return checked(number_in(environment, index), number_in(environment, count), index, count);
}

}  // namespace

Shard shard_from_environment(const Environment& environment) {
  if (environment("SLURM_ARRAY_TASK_ID")) return slurm_shard(environment);
  if (environment("JOB_COMPLETION_INDEX")) return pair_of(environment, "JOB_COMPLETION_INDEX", "SHARD_COUNT");
  if (environment("GTEST_SHARD_INDEX") || environment("GTEST_TOTAL_SHARDS"))
    return pair_of(environment, "GTEST_SHARD_INDEX", "GTEST_TOTAL_SHARDS");
  throw UsageError(
      "--shard auto: no scheduler's variable is set (SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX, "
      "GTEST_SHARD_INDEX); name the shard with --shard-index and --shard-count");
}

std::vector<std::uint32_t> assign_shards(std::span<const ListedAsset> assets, std::uint32_t count) {
  std::vector<std::size_t> order(assets.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    if (assets[a].bytes != assets[b].bytes) return assets[a].bytes > assets[b].bytes;
    return assets[a].path < assets[b].path;
  });
  using Load = std::pair<std::uint64_t, std::uint32_t>;  // of which shard
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (std::uint32_t shard = 0; shard < count; ++shard) loads.emplace(0, shard);
  std::vector<std::uint32_t> shards(assets.size());
  for (const std::size_t asset : order) {
    const auto [load, shard] = loads.top();
    loads.pop();
    shards[asset] = shard;
    loads.emplace(load + assets[asset].bytes + kBytesPerAsset, shard);
  }
  return shards;
}

}  // namespace scene_analyzer::library
