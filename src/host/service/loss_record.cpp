#include "service/loss_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "analysis_file/analysis_file.h"
#include "service/refusal.h"

namespace scene_analyzer::service {
namespace {

constexpr int kTriedOften = 2;
constexpr std::size_t kMostAssets = 1000;

std::pair<std::uint64_t, std::uint64_t> contents_of(const mesh::AssetSource& asset) {
  const auto hash = analysis_file::fingerprint(asset, {}).front().hash;
  return {hash[0], hash[1]};
}

}  // namespace

void LossRecord::add(const mesh::AssetSource& asset) {
  const auto contents = contents_of(asset);
  const std::lock_guard lock(mutex_);
  const auto known =
      std::ranges::find_if(losses_, [&](const Loss& loss) { return loss.contents == contents; });
  if (known != losses_.end()) {
    if (++known->times == kTriedOften) ++refused_;
    return;
  }
  if (losses_.size() == kMostAssets) losses_.pop_front();
  losses_.push_back({contents, 1});
}

std::uint64_t LossRecord::refused() const {
  const std::lock_guard lock(mutex_);
  return refused_;
}

void LossRecord::check(const mesh::AssetSource& asset) const {
  {
    const std::lock_guard lock(mutex_);
    if (std::ranges::none_of(losses_, [](const Loss& loss) { return loss.times >= kTriedOften; })) return;
  }
  const auto contents = contents_of(asset);
  const std::lock_guard lock(mutex_);
  for (const Loss& loss : losses_)
    if (loss.contents == contents && loss.times >= kTriedOften)
      throw Refusal(
          Reason::kTooLarge,
          fmt::format("{}: the device was lost {} times when nothing but this asset was on it; this "
                      "service does not try it again before it is restarted",
                      asset.name, loss.times));
}

}  // namespace scene_analyzer::service
