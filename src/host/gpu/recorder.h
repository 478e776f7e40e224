// recorder.h — Records dispatches and draws into one command buffer. The one place where barriers, limits and
// group counts are decided.
//
// A stage's record() records into the caller's Recorder and never submits. Before each dispatch, fill or copy
// the recorder inserts one global memory barrier against everything recorded before, so stages need no
// barriers of their own.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "gpu/device.h"

namespace scene_analyzer::gpu {

struct NoParams {};  // for kernels without a parameter block

class Recorder {
 public:
  // With `profile`, timestamps bracket every dispatch and every rendering (see timings()).
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

  // --- Drawing, on devices that can (DeviceInfo::can_draw) ---

  // Both images; `depth` is the farthest. To be called before the first rendering into a target.
  void clear(const RenderTarget& target, const std::array<float, 4>& color, float depth = 1);
  // Draws go there until end_rendering(), over what is there. Waits for everything recorded before.
  void begin_rendering(const RenderTarget& target);
  void end_rendering();
  struct Draw {
    std::span<const BufferRange> inputs;  // per location of the vertex shader
    const Buffer* indices = nullptr;      // 32-bit; none: the corners are one vertex after the other
    std::uint32_t first_index = 0, index_count = 0;
    std::uint32_t first_vertex = 0;   // added to every index
    std::uint32_t single_inputs = 0;  // bit i: input i has one element, which all vertices read
    const Texture* texture = nullptr;
    std::span<const BufferRange> buffers = {};  // of the fragment shader
    // What of the picture may change: left, top, width and height in pixels. Absent: all of it.
    std::optional<std::array<std::uint32_t, 4>> clip = std::nullopt;
  };
  template <typename Params>
  void draw(const RasterPipeline& pipeline, const Params& params, const Draw& draw) {
    static_assert(std::is_trivially_copyable_v<Params> && sizeof(Params) <= 128);
    draw_bytes(pipeline, &params, std::is_empty_v<Params> ? 0 : sizeof(Params), draw);
  }
  // The colour image of a target that was rendered to: color_bytes() from `offset`, a multiple of 4.
  void copy_color(const RenderTarget& from, const Buffer& to, std::uint64_t offset = 0);

  // From now on counts what every draw of this recorder invokes. Does nothing without
  // DeviceInfo::counts_invocations.
  void count_invocations();
  struct DrawCounts {
    std::uint64_t vertex_invocations = 0, fragment_invocations = 0;
  };
  // Of the last submitted recording, one per draw; empty where nothing was counted.
  const std::vector<DrawCounts>& draw_counts() const;

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
    std::optional<double> nanoseconds;  // absent when the device's clock ran backwards
  };
  // Of the last submitted recording, in order; empty without `profile` or where the queue has no timestamps.
  const std::vector<Timing>& timings() const;

  struct Impl;  // gpu/native.h, for what is recorded from outside (FFT)
  Impl& impl() const { return *impl_; }

 private:
  void run_bytes(const Kernel& kernel, std::uint64_t threads, const void* params, std::uint32_t params_bytes,
                 std::initializer_list<BufferRange> buffers);

  void draw_bytes(const RasterPipeline& pipeline, const void* params, std::uint32_t params_bytes,
                  const Draw& draw);

  std::unique_ptr<Impl> impl_;
  std::vector<std::shared_ptr<void>> kept_;
};

}  // namespace scene_analyzer::gpu
