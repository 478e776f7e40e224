// recorder.h — Records dispatches into one command buffer. The one place where barriers, limits and group
// counts are decided.
//
// A stage's record() records into the caller's Recorder and never submits. Before each dispatch, fill or copy
// the recorder inserts one global memory barrier against everything recorded before, so stages need no
// barriers of their own.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "gpu/device.h"

namespace scene_analyzer::gpu {

struct NoParams {};  // for kernels without a parameter block

class Recorder {
 public:
  // With `profile`, timestamps bracket every dispatch (see timings()).
  explicit Recorder(Device& device, bool profile = false);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  Device& device() const;

  // One thread per element, at least `threads` of them; the kernel itself leaves out the surplus. 0 threads
  // record nothing. Workgroups beyond 65535 are folded into y: kernels take their index from global_thread()
  // of shaders/compute/lib/threads.glsl. Arguments are bound in order; their number and the size of `params`
  // must equal what the SPIR-V says, and each range must be within maxStorageBufferRange: std::logic_error
  // otherwise, and nothing is recorded. Kernel and buffers must live until the recording has run.
  template <typename Params>
  void run(const Kernel& kernel, std::uint64_t threads, const Params& params,
           std::initializer_list<BufferRange> buffers) {
    static_assert(std::is_trivially_copyable_v<Params> && sizeof(Params) <= 128);
    run_bytes(kernel, threads, &params, std::is_empty_v<Params> ? 0 : sizeof(Params), buffers);
  }

  // Whole workgroups instead of threads.
  template <typename Params>
  void run_groups(const Kernel& kernel, std::uint64_t groups, const Params& params,
                  std::initializer_list<BufferRange> buffers) {
    run(kernel, groups * kernel.local_size(), params, buffers);
  }

  void fill(const BufferRange& range, std::uint32_t word);  // sizes and offsets multiples of 4
  void copy(const Buffer& from, std::uint64_t from_offset, const Buffer& to, std::uint64_t to_offset,
            std::uint64_t bytes);

  // Keeps a scratch object (an Array, or a struct of some) alive until the recording has run.
  template <typename T>
  const T& keep(T scratch) {
    auto owned = std::make_shared<T>(std::move(scratch));
    kept_.push_back(owned);
    return *owned;
  }

  // Submits, waits without a busy loop, frees kept scratch; the recorder is empty again afterwards, after an
  // exception too. Throws DeviceLost, OutOfMemory. Nothing recorded: returns at once.
  void submit_and_wait();

  struct Timing {
    std::string kernel;
    double nanoseconds = 0;
  };
  // Of the last submitted recording, in order; empty without `profile` or where the queue has no timestamps.
  const std::vector<Timing>& timings() const;

  struct Impl;  // gpu/native.h, for what is recorded from outside (FFT)
  Impl& impl() const { return *impl_; }

 private:
  void run_bytes(const Kernel& kernel, std::uint64_t threads, const void* params, std::uint32_t params_bytes,
                 std::initializer_list<BufferRange> buffers);

  std::unique_ptr<Impl> impl_;
  std::vector<std::shared_ptr<void>> kept_;
};

}  // namespace scene_analyzer::gpu
