#include "library/import_pool.h"

#include <utility>

namespace scene_analyzer::library {

ImportPool::ImportPool(pipeline::Pipeline& pipeline, std::span<const std::string> assets, unsigned threads,
                       std::uint64_t most_bytes)
    : pipeline_(pipeline), assets_(assets), most_bytes_(most_bytes) {
  for (unsigned i = 0; i < threads && i < assets.size(); ++i) threads_.emplace_back([this] { run(); });
}

ImportPool::~ImportPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
}

std::optional<std::size_t> ImportPool::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(
      lock, [&] { return stopping_ || begun_ == assets_.size() || (!paused_ && held_bytes_ < most_bytes_); });
  if (stopping_ || begun_ == assets_.size()) return std::nullopt;
  ++busy_;
  return begun_++;
}

void ImportPool::run() {
  while (const auto asset = next()) {
    Prepared prepared{.asset = *asset, .analysis = nullptr};
    std::exception_ptr error;
    try {
      prepared.analysis = pipeline_.prepare(assets_[*asset]);
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    --busy_;
    if (error) {
      error_ = error;
      stopping_ = true;
    } else {
      prepared.bytes = prepared.analysis->held_bytes();
      held_bytes_ += prepared.bytes;
      ready_.push_back(std::move(prepared));
    }
    changed_.notify_all();
  }
}

std::optional<ImportPool::Prepared> ImportPool::take(
    std::optional<std::chrono::steady_clock::time_point> deadline) {
  std::unique_lock lock(mutex_);
  const auto over = [&] { return error_ || !ready_.empty() || taken_ == assets_.size(); };
  if (deadline)
    changed_.wait_until(lock, *deadline, over);
  else
    changed_.wait(lock, over);
  if (error_) std::rethrow_exception(error_);
  if (ready_.empty()) return std::nullopt;
  ++taken_;
  Prepared prepared = std::move(ready_.front());
  ready_.pop_front();
  return prepared;
}

bool ImportPool::has_more() const {
  const std::lock_guard lock(mutex_);
  return taken_ < assets_.size();
}

void ImportPool::release(std::uint64_t bytes) {
  {
    const std::lock_guard lock(mutex_);
    held_bytes_ -= bytes;
  }
  changed_.notify_all();
}

void ImportPool::pause() {
  std::unique_lock lock(mutex_);
  paused_ = true;
  changed_.wait(lock, [&] { return busy_ == 0; });
}

void ImportPool::resume() {
  {
    const std::lock_guard lock(mutex_);
    paused_ = false;
  }
  changed_.notify_all();
}

}  // namespace scene_analyzer::library
