#include "rpc/peer_watch.h"

namespace scene_analyzer::rpc {
namespace {

constexpr std::size_t kLeastReadingSpeed = 64 << 10;  // bytes per second

}  // namespace

PeerWatch::PeerWatch(std::chrono::seconds patience) : patience_(patience), thread_([this] { run(); }) {}

PeerWatch::~PeerWatch() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
}

PeerWatch::Wait::Wait(PeerWatch& watch, grpc::ServerContext& context, std::size_t bytes)
    : watch_(watch),
      context_(context),
      deadline_(std::chrono::steady_clock::now() + watch.patience_ +
                std::chrono::seconds(bytes / kLeastReadingSpeed)) {
  const std::lock_guard lock(watch_.mutex_);
  place_ = watch_.waiting_.insert(watch_.waiting_.end(), this);
}

PeerWatch::Wait::~Wait() {
  const std::lock_guard lock(watch_.mutex_);
  if (place_ != watch_.waiting_.end()) watch_.waiting_.erase(place_);
}

// Looks once a second: patience is counted in seconds, and waits come and go thousands of times in one.
void PeerWatch::run() {
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, std::chrono::seconds(1), [&] { return stopping_; })) {
    const auto now = std::chrono::steady_clock::now();
    for (auto wait = waiting_.begin(); wait != waiting_.end();) {
      Wait& one = **wait;
      if (one.deadline_ > now) {
        ++wait;
        continue;
      }
      one.context_.TryCancel();
      one.place_ = waiting_.end();
      wait = waiting_.erase(wait);
    }
  }
}

}  // namespace scene_analyzer::rpc
