#include "gpu/stopwatch.h"

#include <algorithm>

#include "gpu/error.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::gpu {
namespace {

constexpr std::uint32_t kBracketsPerPool = 256;
constexpr std::uint32_t kQueriesPerPool = 2 * kBracketsPerPool;

}  // namespace

Stopwatch::Stopwatch(const vk::raii::Device& device, double nanoseconds_per_tick, std::uint32_t valid_bits)
    : device_(&device), nanoseconds_per_tick_(nanoseconds_per_tick), valid_bits_(valid_bits) {}

std::optional<std::uint64_t> elapsed_ticks(std::uint64_t from, std::uint64_t to, std::uint32_t valid_bits) {
  const std::uint64_t mask = valid_bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << valid_bits) - 1;
  const std::uint64_t elapsed = (to - from) & mask;
  // No bracket takes half a counter's range: the second reading lies before the first.
  if (elapsed > mask / 2) return std::nullopt;
  return elapsed;
}

void Stopwatch::start(const vk::raii::CommandBuffer& commands, const std::string& name) {
  const auto bracket = static_cast<std::uint32_t>(names_.size());
  const std::uint32_t pool = bracket / kBracketsPerPool;
  if (pool == pools_.size())
    pools_.emplace_back(*device_, vk::QueryPoolCreateInfo{.queryType = vk::QueryType::eTimestamp,
                                                          .queryCount = kQueriesPerPool});
  // From the host: commands could not do it between the draws of one rendering.
  if (bracket % kBracketsPerPool == 0) pools_[pool].reset(0, kQueriesPerPool);
  // All commands, not the top of the pipe: the bracket must not begin while earlier work is still running.
  commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *pools_[pool],
                           2 * (bracket % kBracketsPerPool));
  names_.push_back(name);
}

void Stopwatch::stop(const vk::raii::CommandBuffer& commands) {
  const auto bracket = static_cast<std::uint32_t>(names_.size() - 1);
  commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *pools_[bracket / kBracketsPerPool],
                           2 * (bracket % kBracketsPerPool) + 1);
}

std::vector<Recorder::Timing> Stopwatch::take() {
  std::vector<Recorder::Timing> timings;
  for (std::size_t first = 0; first < names_.size(); first += kBracketsPerPool) {
    const auto count =
        static_cast<std::uint32_t>(std::min<std::size_t>(kBracketsPerPool, names_.size() - first));
    const auto& pool = pools_[first / kBracketsPerPool];
    const auto [result, ticks] =
        pool.getResults<std::uint64_t>(0, 2 * count, 2 * count * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                       vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    if (result != vk::Result::eSuccess) throw Error("reading GPU timestamps: " + vk::to_string(result));
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto elapsed = elapsed_ticks(ticks[2 * i], ticks[2 * i + 1], valid_bits_);
      std::optional<double> nanoseconds;
      if (elapsed) nanoseconds = static_cast<double>(*elapsed) * nanoseconds_per_tick_;
      timings.push_back({names_[first + i], nanoseconds});
    }
  }
  names_.clear();
  return timings;
}

}  // namespace scene_analyzer::gpu
