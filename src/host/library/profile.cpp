#include "library/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "analysis_file/analysis_file.h"
#include "base/error.h"
#include "gpu/error.h"
#include "library/import_pool.h"
#include "pipeline/pending_pack.h"

namespace scene_analyzer::library {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

// What goes to the device together: enough to make its fixed costs small, and not so much that a killed run
// has much to do again.
constexpr std::size_t kMostAssets = 64;
constexpr std::uint64_t kFillingTriangles = 500'000;
constexpr auto kLongestWait = 1s;  // for more of them
constexpr auto kBetweenChecks = 100ms;
constexpr int kMostLosses = 3;  // of devices, without an asset measured in between

// Assets that are on the device or waiting for their start triangles.
struct Pack {
  std::vector<std::size_t> assets;
  std::uint64_t bytes = 0, triangles = 0;
  Clock::time_point begin;
  std::vector<std::unique_ptr<pipeline::PendingAnalysis>> prepared;  // until it is started
  std::unique_ptr<pipeline::PendingPack> pending;

  bool is_full() const { return assets.size() >= kMostAssets || triangles >= kFillingTriangles; }
};

std::uint64_t kept_triangles(const analysis::AssetAnalysis& analysis) {
  std::uint64_t triangles = 0;
  for (const auto& geometry : analysis.geometries) triangles += geometry.triangles;
  return triangles;
}

std::string first_limit(const analysis::AssetAnalysis& analysis) {
  for (const auto& geometry : analysis.geometries)
    if (is_beyond_a_limit(geometry))
      return geometry.not_analysed.empty() ? geometry.no_fourier_transform : geometry.not_analysed;
  return {};
}

class Profile {
 public:
  Profile(std::span<const std::string> assets, const ProfileOptions& options, Journal& journal,
          const ProfileEvents& events)
      : assets_(assets),
        options_(options),
        journal_(journal),
        events_(events),
        pipeline_(options.pipeline, events.device) {}

  ProfileResult run() {
    {
      ImportPool pool(pipeline_, assets_, options_.jobs, options_.most_bytes);
      while (pool.has_more()) {
        Pack pack = gather(pool);
        measure_beside(pool, std::move(pack));
      }
      if (open_) finish(pool, *std::exchange(open_, nullptr));
    }
    for (const std::size_t asset : again_) analyse_alone(asset);
    return result_;
  }

 private:
  // Until the pack is full, or nothing more has come for a while.
  Pack gather(ImportPool& pool) {
    Pack pack;
    std::optional<Clock::time_point> deadline;
    const auto is_large = [&] { return !pack.assets.empty() && pack.bytes >= options_.most_bytes / 2; };
    while (!pack.is_full() && !is_large() && pool.has_more()) {
      events_.check();
      if (open_ && !open_->pending->is_searching()) finish(pool, *std::exchange(open_, nullptr));
      if (deadline && Clock::now() >= *deadline) break;
      auto next = pool.take(Clock::now() + kBetweenChecks);
      if (!next) continue;
      if (!deadline) pack.begin = Clock::now();
      if (!deadline) deadline = pack.begin + kLongestWait;
      pack.assets.push_back(next->asset);
      pack.bytes += next->analysis->scene_bytes();
      pack.triangles += next->analysis->triangles();
      pack.prepared.push_back(std::move(next->analysis));
    }
    return pack;
  }

  // One pack's start triangles are searched on the host while the next is on the device.
  void measure_beside(ImportPool& pool, Pack pack) {
    if (pipeline_.is_timed_alone() && open_) finish(pool, *std::exchange(open_, nullptr));
    auto next = std::make_unique<Pack>(std::move(pack));
    try {
      next->pending = pipeline_.start_pack(std::move(next->prepared));
    } catch (const gpu::DeviceLost& error) {
      lose(pool, *next, error);
      next = nullptr;
    }
    if (open_) finish(pool, *std::exchange(open_, nullptr));
    open_ = std::move(next);
  }

  void finish(ImportPool& pool, Pack& pack) {
    try {
      events_.check();
      const auto outcomes = pipeline_.finish_pack(std::move(pack.pending));
      const std::chrono::duration<double> seconds = Clock::now() - pack.begin;
      for (std::size_t i = 0; i < outcomes.size(); ++i)
        note(pack.assets[i], outcomes[i], seconds.count() / static_cast<double>(outcomes.size()), true);
      losses_ = 0;
    } catch (const gpu::DeviceLost& error) {
      return lose(pool, pack, error);
    }
    pool.release(pack.bytes);
  }

  // Nobody knows which of them it was: each is tried alone.
  void lose(ImportPool& pool, Pack& pack, const gpu::DeviceLost& error) {
    again_.insert(again_.end(), pack.assets.begin(), pack.assets.end());
    pack.pending.reset();
    pool.release(pack.bytes);
    if (open_ && open_.get() != &pack) {
      again_.insert(again_.end(), open_->assets.begin(), open_->assets.end());
      const auto former = std::exchange(open_, nullptr);
      former->pending.reset();
      pool.release(former->bytes);
    }
    count_loss(error);
  }

  void count_loss(const gpu::DeviceLost& error) {
    if (++losses_ > kMostLosses) throw gpu::DeviceLost(error);
    pipeline_.forget_device();
  }

  void analyse_alone(std::size_t asset) {
    const auto begin = Clock::now();
    pipeline::Outcome outcome;
    try {
      events_.check();
      outcome = pipeline_.analyze(assets_[asset], [&](double, const std::string&) { events_.check(); });
      losses_ = 0;
    } catch (const gpu::DeviceLost& error) {
      count_loss(error);
      outcome.error = fmt::format("{}: {}", assets_[asset], error.what());
    }
    note(asset, outcome, std::chrono::duration<double>(Clock::now() - begin).count(), false);
  }

  void note(std::size_t asset, const pipeline::Outcome& outcome, double seconds, bool may_try_again) {
    if (!outcome.write_error.empty()) throw UsageError(outcome.write_error);
    const bool changed = outcome.analysis && !outcome.kept && !is_beyond_a_limit(*outcome.analysis);
    if (may_try_again && (outcome.may_succeed_alone || changed)) {
      again_.push_back(asset);
      return;
    }
    Record record = record_of(asset, outcome, seconds);
    count(record.status, outcome.from_file);
    const Record* known = journal_.find(record.asset);
    if (outcome.from_file && known != nullptr && known->content_key == record.content_key)
      record = *known;  // which has the times
    else
      journal_.add(record);
    events_.finished(record, outcome.from_file);
  }

  Record record_of(std::size_t asset, const pipeline::Outcome& outcome, double seconds) const {
    Record record;
    record.asset = assets_[asset];
    record.finished = utc_now();
    record.seconds = seconds;
    if (outcome.import) record.import_seconds = outcome.import->seconds;
    record.warning_count = outcome.messages.size();
    record.warnings.assign(outcome.messages.begin(),
                           outcome.messages.begin() +
                               static_cast<std::ptrdiff_t>(std::min(outcome.messages.size(), kMostWarnings)));
    if (!outcome.analysis) {
      record.reason = outcome.error;
      return record;
    }
    const analysis::AssetAnalysis& analysis = *outcome.analysis;
    record.meshes = analysis.instances.size();
    record.triangles = kept_triangles(analysis);
    if (!analysis.files.empty()) record.bytes = analysis.files.front().size;
    if (outcome.kept) {
      record.status = Status::kAnalysed;
      record.content_key = analysis_file::content_key(analysis);
      record.analysis = analysis_file::path_for(record.asset, options_.pipeline.cache_folder)
                            .lexically_relative(options_.folder)
                            .string();
    } else if (is_beyond_a_limit(analysis)) {
      record.status = Status::kIncomplete;
      record.reason = first_limit(analysis);
    } else {
      record.reason = fmt::format("{}: the file changes while it is read", record.asset);
    }
    return record;
  }

  void count(Status status, bool unchanged) {
    if (status == Status::kAnalysed) ++result_.analysed;
    if (status == Status::kIncomplete) ++result_.incomplete;
    if (status == Status::kFailed) ++result_.failed;
    if (status == Status::kAnalysed && unchanged) ++result_.unchanged;
  }

  const std::span<const std::string> assets_;
  const ProfileOptions& options_;
  Journal& journal_;
  const ProfileEvents& events_;
  ProfileResult result_;
  std::vector<std::size_t> again_;  // to be tried alone
  int losses_ = 0;
  pipeline::Pipeline pipeline_;
  std::unique_ptr<Pack> open_;  // last: it ends before the pipeline
};

}  // namespace

ProfileResult profile(std::span<const std::string> assets, const ProfileOptions& options, Journal& journal,
                      const ProfileEvents& events) {
  return Profile(assets, options, journal, events).run();
}

}  // namespace scene_analyzer::library
