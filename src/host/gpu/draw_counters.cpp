#include "gpu/draw_counters.h"

#include <algorithm>

#include "gpu/error.h"

namespace scene_analyzer::gpu {
namespace {

constexpr std::uint32_t kDrawsPerPool = 256;
// In the order in which queries return them, that of their bits.
constexpr auto kStatistics = vk::QueryPipelineStatisticFlagBits::eVertexShaderInvocations |
                             vk::QueryPipelineStatisticFlagBits::eFragmentShaderInvocations;

}  // namespace

void DrawCounters::start(const vk::raii::CommandBuffer& commands) {
  const std::uint32_t pool = count_ / kDrawsPerPool;
  if (pool == pools_.size())
    pools_.emplace_back(*device_, vk::QueryPoolCreateInfo{.queryType = vk::QueryType::ePipelineStatistics,
                                                          .queryCount = kDrawsPerPool,
                                                          .pipelineStatistics = kStatistics});
  // From the host: commands could not do it between the draws of one rendering.
  if (count_ % kDrawsPerPool == 0) pools_[pool].reset(0, kDrawsPerPool);
  commands.beginQuery(*pools_[pool], count_ % kDrawsPerPool, {});
}

void DrawCounters::stop(const vk::raii::CommandBuffer& commands) {
  commands.endQuery(*pools_[count_ / kDrawsPerPool], count_ % kDrawsPerPool);
  ++count_;
}

std::vector<Recorder::DrawCounts> DrawCounters::take() {
  std::vector<Recorder::DrawCounts> counts;
  for (std::uint32_t first = 0; first < count_; first += kDrawsPerPool) {
    const std::uint32_t here = std::min(kDrawsPerPool, count_ - first);
    const auto [result, values] = pools_[first / kDrawsPerPool].getResults<std::uint64_t>(
        0, here, 2 * here * sizeof(std::uint64_t), 2 * sizeof(std::uint64_t),
        vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    if (result != vk::Result::eSuccess) throw Error("reading draw statistics: " + vk::to_string(result));
    for (std::uint32_t i = 0; i < here; ++i) counts.push_back({values[2 * i], values[2 * i + 1]});
  }
  count_ = 0;
  return counts;
}

}  // namespace scene_analyzer::gpu
