// admission.h — How many requests are taken at the same time.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace scene_analyzer::service {

class Admission {
 public:
  // At most `most` requests, from their first byte to their answer.
  explicit Admission(std::size_t most) : most_(most) {}

  // Holds a request's place until it is destroyed.
  class Ticket {
   public:
    explicit Ticket(Admission& admission) : admission_(admission) {}
    ~Ticket() { admission_.leave(std::chrono::steady_clock::now() - begin_); }
    Ticket(const Ticket&) = delete;
    Ticket& operator=(const Ticket&) = delete;

   private:
    Admission& admission_;
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  };

  // Throws Refusal: kBusy, with the time after which a place is likely to be free; kUnavailable after
  // close().
  Ticket admit();
  // Nobody is admitted any more.
  void close();
  // Whether all have left before `deadline`.
  bool wait_until_empty(std::chrono::steady_clock::time_point deadline);
  std::size_t admitted() const;

 private:
  void leave(std::chrono::steady_clock::duration taken);

  const std::size_t most_;
  mutable std::mutex mutex_;
  std::condition_variable left_;
  std::size_t admitted_ = 0;
  bool closed_ = false;
  std::size_t refused_ = 0;    // since a place became free
  double mean_seconds_ = 0.5;  // of requests of late, from begin to end
};

}  // namespace scene_analyzer::service
