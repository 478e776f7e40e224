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
#include "library/asset_list.h"
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
  std::size_t noted = 0;                                             // of the assets, the first of them
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
      pack.bytes += next->bytes;
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
    const std::unique_ptr<Pack> former = std::exchange(open_, std::move(next));
    if (former) finish(pool, *former);
  }

  // Where the processors draw, imports would be timed with the pictures.
  void finish(ImportPool& pool, Pack& pack) {
    const bool is_timed_alone = pipeline_.is_timed_alone();
    if (is_timed_alone) pool.pause();
    try {
      events_.check();
      finish(pack);
      losses_ = 0;
      pool.release(pack.bytes);
    } catch (const gpu::DeviceLost& error) {
      lose(pool, pack, error);
    }
    if (is_timed_alone) pool.resume();
  }

  void finish(Pack& pack) {
    const auto seconds = [](Clock::duration time) { return std::chrono::duration<double>(time).count(); };
    auto mark = Clock::now();
    const double together = seconds(mark - pack.begin) / static_cast<double>(pack.assets.size());
    pipeline_.finish_pack(std::move(pack.pending), [&](std::size_t i, const pipeline::Outcome& outcome) {
      events_.check();
      const auto now = Clock::now();
      note(pack.assets[i], outcome, together + seconds(now - std::exchange(mark, now)), true);
      pack.noted = i + 1;
    });
  }

  // Nobody knows which of them it was: each is tried alone. Nothing that is pending outlives the device.
  void lose(ImportPool& pool, Pack& pack, const gpu::DeviceLost& error) {
    give_up(pool, pack);
    if (const auto other = std::exchange(open_, nullptr)) give_up(pool, *other);
    count_loss(error);
  }

  void give_up(ImportPool& pool, Pack& pack) {
    again_.insert(again_.end(), pack.assets.begin() + static_cast<std::ptrdiff_t>(pack.noted),
                  pack.assets.end());
    pack.pending.reset();
    pool.release(pack.bytes);
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
    if (!outcome.write_error.empty() && !outcome.others_can_be_written)
      throw UsageError(fmt::format("{}; what was analysed is kept, and the same command goes on from there",
                                   outcome.write_error));
    const bool changed = outcome.analysis && !outcome.kept && outcome.write_error.empty() &&
                         !is_beyond_a_limit(*outcome.analysis);
    if (may_try_again && (outcome.may_succeed_alone || changed)) {
      again_.push_back(asset);
      return;
    }
    Record record = record_of(asset, outcome, seconds);
    count(record.status, outcome.from_file);
    const Record* known = journal_.find(record.asset);
    const bool is_known = outcome.from_file && known != nullptr && known->content_key == record.content_key;
    if (is_known) record = known_again(*known, std::move(record));
    if (!is_known || record != *known) journal_.add(record);
    events_.finished(record, outcome.from_file);
  }

  // With the times of when it was measured.
  static Record known_again(const Record& known, Record now) {
    Record record = known;
    record.metrics |= now.metrics;
    if (record != known) record.finished = std::move(now.finished);
    return record;
  }

  Record record_of(std::size_t asset, const pipeline::Outcome& outcome, double seconds) const {
    Record record;
    record.asset = assets_[asset];
    record.finished = utc_now();
    record.metrics = options_.pipeline.metrics;
    record.seconds = seconds;
    if (outcome.import) record.import_seconds = outcome.import->seconds;
    record.warning_count = outcome.messages.size();
    record.warnings.assign(outcome.messages.begin(),
                           outcome.messages.begin() +
                               static_cast<std::ptrdiff_t>(std::min(outcome.messages.size(), kMostWarnings)));
    if (!outcome.analysis) {
      record.bytes = bytes_of(record.asset);
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
    } else if (!outcome.write_error.empty()) {
      record.reason = fmt::format("{}: {}", record.asset, outcome.write_error);
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
