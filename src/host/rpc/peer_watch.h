// peer_watch.h — Ends calls whose client neither sends nor reads what it is expected to.
//
// Reading from a client, and writing to one that does not read, blocks for as long as the client likes; a
// connection that was cut off without a word is noticed by keepalive, a client that is merely silent is not.
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <condition_variable>
#include <list>
#include <mutex>
#include <thread>

namespace scene_analyzer::rpc {

class PeerWatch {
 public:
  explicit PeerWatch(std::chrono::seconds patience);
  ~PeerWatch();
  PeerWatch(const PeerWatch&) = delete;
  PeerWatch& operator=(const PeerWatch&) = delete;

  // While it lives, `context` waits for its client; after the time it is cancelled.
  class Wait {
   public:
    // `bytes` that are to be sent meanwhile prolong it, at 64 KiB per second.
    Wait(PeerWatch& watch, grpc::ServerContext& context, std::size_t bytes = 0);
    ~Wait();
    Wait(const Wait&) = delete;
    Wait& operator=(const Wait&) = delete;

   private:
    friend class PeerWatch;
    PeerWatch& watch_;
    grpc::ServerContext& context_;
    const std::chrono::steady_clock::time_point deadline_;
    std::list<Wait*>::iterator place_;
  };

  std::chrono::seconds patience() const { return patience_; }

 private:
  void run();

  const std::chrono::seconds patience_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Wait*> waiting_;
  bool stopping_ = false;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace scene_analyzer::rpc
