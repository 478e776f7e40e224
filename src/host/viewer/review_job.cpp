#include "viewer/review_job.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <map>
#include <system_error>
#include <utility>

namespace scene_analyzer::viewer {
namespace {

namespace fs = std::filesystem;

// Leaves the pipeline between two steps; not a std::runtime_error, so that no handler of ordinary errors
// takes it.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "the review was closed"; }
};

void check(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Stopped();
}

// One spelling per file.
fs::path identity(const fs::path& asset) {
  std::error_code error;
  fs::path canonical = fs::weakly_canonical(asset, error);
  return error ? asset : canonical;
}

}  // namespace

ReviewJob::ReviewJob(std::vector<fs::path> assets, pipeline::Options options, gpu::DeviceOptions device,
                     std::function<void()> on_change)
    : assets_(std::move(assets)),
      on_change_(std::move(on_change)),
      progress_{.assets = assets_.size(), .name = {}, .step = {}},
      thread_([this, options = std::move(options), device = std::move(device)](const std::stop_token& stop) {
        run(stop, options, device);
      }) {}

ReviewJob::Progress ReviewJob::progress() const {
  const std::scoped_lock lock(mutex_);
  return progress_;
}

std::vector<ReviewJob::Finished> ReviewJob::take_finished() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(finished_, {});
}

bool ReviewJob::done() const {
  const std::scoped_lock lock(mutex_);
  return done_;
}

std::optional<std::string> ReviewJob::failure() const {
  const std::scoped_lock lock(mutex_);
  return failure_;
}

std::vector<std::string> ReviewJob::take_validation_messages() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(validation_messages_, {});
}

void ReviewJob::run(const std::stop_token& stop, pipeline::Options options,
                    const gpu::DeviceOptions& device) {
  options.import_limits.stop = stop;
  std::optional<std::string> failure;
  try {
    AssetReviewer reviewer(std::move(options), device);
    review_all(stop, reviewer);
  } catch (const Stopped&) {
  } catch (const import::Stopped&) {
  } catch (const std::exception& error) {
    failure = error.what();
  }
  {
    const std::scoped_lock lock(mutex_);
    failure_ = std::move(failure);
    done_ = true;
  }
  tell();
}

void ReviewJob::review_all(const std::stop_token& stop, AssetReviewer& reviewer) {
  std::map<fs::path, std::size_t> times;  // that a file is still to come
  for (const fs::path& asset : assets_) ++times[identity(asset)];
  std::map<fs::path, Finished> known;  // those that are
  for (std::size_t i = 0; i < assets_.size(); ++i) {
    begin(i);
    const fs::path file = identity(assets_[i]);
    const auto progress = [&](double fraction, const std::string& step) {
      check(stop);
      report(fraction, step);
    };
    check(stop);
    const auto repeated = known.find(file);
    Finished finished = repeated != known.end() ? repeated->second : reviewer.review(assets_[i], progress);
    finished.asset = i;
    finished.analysis.asset = assets_[i].string();
    if (--times[file] == 0)
      known.erase(file);
    else
      known.try_emplace(file, finished);
    keep_validation_messages(reviewer);
    check(stop);
    deliver(std::move(finished));
  }
}

void ReviewJob::begin(std::size_t asset) {
  {
    const std::scoped_lock lock(mutex_);
    progress_ = {
        .asset = asset, .assets = assets_.size(), .name = assets_[asset].filename().string(), .step = {}};
  }
  tell();
}

void ReviewJob::report(double fraction, const std::string& step) {
  {
    const std::scoped_lock lock(mutex_);
    progress_.step = step;
    progress_.fraction = std::clamp(fraction, progress_.fraction, 1.0);
  }
  tell();
}

void ReviewJob::deliver(Finished finished) {
  {
    const std::scoped_lock lock(mutex_);
    const std::size_t following = finished.asset + 1;
    finished_.push_back(std::move(finished));
    if (following == assets_.size())
      progress_ = {.asset = following, .assets = following, .name = {}, .step = {}, .fraction = 1};
  }
  tell();
}

void ReviewJob::keep_validation_messages(AssetReviewer& reviewer) {
  std::vector<std::string> messages = reviewer.take_validation_messages();
  const std::scoped_lock lock(mutex_);
  std::ranges::move(messages, std::back_inserter(validation_messages_));
}

void ReviewJob::tell() const {
  if (on_change_) on_change_();
}

}  // namespace scene_analyzer::viewer
