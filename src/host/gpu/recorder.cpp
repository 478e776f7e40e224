#include "gpu/recorder.h"

#include <array>
#include <stdexcept>

#include "gpu/error.h"
#include "gpu/native.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::gpu {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

// What every Vulkan device offers in x; one number for all devices, so that folding is tested everywhere.
constexpr std::uint64_t kMaxGroups = 65535;
constexpr std::size_t kMaxBuffers = 32;  // the least maxPushDescriptors

// The size in bytes, with "to the end" resolved.
std::uint64_t checked_size(const std::string& where, const BufferRange& range) {
  if (range.buffer == nullptr || !*range.buffer) wrong(where, "a buffer is empty");
  const std::uint64_t bytes = range.buffer->bytes();
  const std::string name = "buffer '" + range.buffer->name() + "' of " + std::to_string(bytes) + " bytes";
  if (range.offset_bytes >= bytes)
    wrong(where, "offset " + std::to_string(range.offset_bytes) + " is outside " + name);
  const std::uint64_t left = bytes - range.offset_bytes;
  if (range.size_bytes > left)
    wrong(where, std::to_string(range.size_bytes) + " bytes from offset " +
                     std::to_string(range.offset_bytes) + " exceed " + name);
  return range.size_bytes == 0 ? left : range.size_bytes;
}

vk::DescriptorBufferInfo bindable(const Device::Native& native, const std::string& where,
                                  const BufferRange& range) {
  const std::uint64_t size = checked_size(where, range);
  if (range.offset_bytes % native.limits.minStorageBufferOffsetAlignment != 0)
    wrong(where, "offset " + std::to_string(range.offset_bytes) + " into buffer '" + range.buffer->name() +
                     "' is not a multiple of " +
                     std::to_string(native.limits.minStorageBufferOffsetAlignment));
  if (size > native.limits.maxStorageBufferRange)
    wrong(where, std::to_string(size) + " bytes of buffer '" + range.buffer->name() +
                     "' exceed maxStorageBufferRange, " +
                     std::to_string(native.limits.maxStorageBufferRange));
  return {.buffer = *range.buffer->impl().buffer, .offset = range.offset_bytes, .range = size};
}

struct Groups {
  std::uint32_t x = 0, y = 0;
};

// Rows as equal as possible, so that fewer than `y` groups are surplus.
Groups fold(const std::string& where, std::uint64_t threads, std::uint32_t local_size) {
  const std::uint64_t groups = threads / local_size + (threads % local_size != 0);
  const std::uint64_t y = groups / kMaxGroups + (groups % kMaxGroups != 0);
  const std::uint64_t x = groups / y + (groups % y != 0);
  // The index that global_thread() computes has 32 bits.
  if (y > kMaxGroups || x * y * local_size > std::uint64_t{1} << 32)
    wrong(where, std::to_string(threads) + " threads exceed 32-bit indices");
  return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
}

void check_arguments(const Kernel& kernel, std::uint32_t params_bytes, std::size_t buffer_count) {
  const std::string where = "kernel '" + kernel.name() + "'";
  if (params_bytes != kernel.push_constant_bytes())
    wrong(where, "got " + std::to_string(params_bytes) + " bytes of parameters, the shader has " +
                     std::to_string(kernel.push_constant_bytes()));
  if (buffer_count != kernel.buffer_count())
    wrong(where, "got " + std::to_string(buffer_count) + " buffers, the shader has " +
                     std::to_string(kernel.buffer_count()));
  if (buffer_count > kMaxBuffers)
    wrong(where, "at most " + std::to_string(kMaxBuffers) + " buffers can be bound");
}

void record_memory_barrier(const vk::raii::CommandBuffer& commands, const vk::MemoryBarrier2& barrier) {
  commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
}

void record_dispatch(const vk::raii::CommandBuffer& commands, const Kernel::Impl& kernel, const void* params,
                     std::span<const vk::DescriptorBufferInfo> buffers, Groups groups) {
  std::array<vk::WriteDescriptorSet, kMaxBuffers> writes;
  for (std::uint32_t i = 0; i < buffers.size(); ++i)
    writes[i] = {.dstBinding = i,
                 .descriptorCount = 1,
                 .descriptorType = vk::DescriptorType::eStorageBuffer,
                 .pBufferInfo = &buffers[i]};
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, *kernel.pipeline);
  if (!buffers.empty())
    commands.pushDescriptorSetKHR(vk::PipelineBindPoint::eCompute, *kernel.layout, 0,
                                  {static_cast<std::uint32_t>(buffers.size()), writes.data()});
  if (kernel.push_constant_bytes != 0)
    commands.pushConstants<std::byte>(*kernel.layout, vk::ShaderStageFlagBits::eCompute, 0,
                                      {kernel.push_constant_bytes, static_cast<const std::byte*>(params)});
  commands.dispatch(groups.x, groups.y, 1);
}

}  // namespace

void wrong(const std::string& where, const std::string& what) {
  throw std::logic_error(where + ": " + what);
}

void record_barrier(const vk::raii::CommandBuffer& commands) {
  record_memory_barrier(commands, {.srcStageMask = Stage::eComputeShader | Stage::eAllTransfer,
                                   .srcAccessMask = Access::eShaderWrite | Access::eTransferWrite,
                                   .dstStageMask = Stage::eComputeShader | Stage::eAllTransfer,
                                   .dstAccessMask = Access::eShaderRead | Access::eShaderWrite |
                                                    Access::eTransferRead | Access::eTransferWrite});
}

void record_barrier_for_drawing(const vk::raii::CommandBuffer& commands) {
  record_memory_barrier(commands, {.srcStageMask = Stage::eAllCommands,
                                   .srcAccessMask = Access::eMemoryWrite,
                                   .dstStageMask = Stage::eAllCommands,
                                   .dstAccessMask = Access::eMemoryRead | Access::eMemoryWrite});
}

void record_barrier_to_host(const vk::raii::CommandBuffer& commands) {
  record_memory_barrier(commands, {.srcStageMask = Stage::eComputeShader | Stage::eAllTransfer,
                                   .srcAccessMask = Access::eShaderWrite | Access::eTransferWrite,
                                   .dstStageMask = Stage::eHost,
                                   .dstAccessMask = Access::eHostRead});
}

Recorder::Impl::Impl(Device& owner, bool profile) : device(owner), commands(owner.native().make_commands()) {
  const Device::Native& native = owner.native();
  if (profile && native.info.timestamp_bits != 0)
    stopwatch.emplace(native.device, native.info.timestamp_period_ns, native.info.timestamp_bits);
}

const vk::raii::CommandBuffer& Recorder::Impl::next_step() {
  if (device.native().lost) throw DeviceLost(device_lost_message("recording"));
  if (step_count == 0)
    translated("beginning a recording",
               [&] { commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit}); });
  if (rendering) wrong("recorder", "end_rendering() was not called");
  ++step_count;
  if (std::exchange(drawn, false))
    record_barrier_for_drawing(commands);
  else
    record_barrier(commands);
  return commands;
}

// The recording as a whole, whatever state its command buffer is in. On a lost device nothing can be made,
// and nothing will be recorded again.
void Recorder::Impl::drop() {
  if (stopwatch) stopwatch->clear();
  if (counters) counters->clear();
  if (!device.native().lost) commands = device.native().make_commands();
}

Recorder::Recorder(Device& device, bool profile) : impl_(std::make_unique<Impl>(device, profile)) {}
Recorder::~Recorder() = default;

Device& Recorder::device() const {
  return impl_->device;
}
const std::vector<Recorder::Timing>& Recorder::timings() const {
  return impl_->timings;
}

void Recorder::run_bytes(const Kernel& kernel, std::uint64_t threads, const void* params,
                         std::uint32_t params_bytes, std::initializer_list<BufferRange> buffers) {
  check_arguments(kernel, params_bytes, buffers.size());
  const std::string where = "kernel '" + kernel.name() + "'";
  std::array<vk::DescriptorBufferInfo, kMaxBuffers> bound;
  std::size_t count = 0;
  for (const BufferRange& range : buffers) bound[count++] = bindable(impl_->device.native(), where, range);
  if (threads == 0) return;
  const Groups groups = fold(where, threads, kernel.local_size());

  const vk::raii::CommandBuffer& commands = impl_->next_step();
  const auto dispatch = [&] {
    record_dispatch(commands, kernel.impl(), params, {bound.data(), count}, groups);
  };
  if (!impl_->stopwatch) return dispatch();
  translated("recording a timestamp", [&] { impl_->stopwatch->start(commands, kernel.name()); });
  dispatch();
  impl_->stopwatch->stop(commands);
}

void Recorder::fill(const BufferRange& range, std::uint32_t word) {
  const std::uint64_t size = checked_size("fill", range);
  if (range.offset_bytes % 4 != 0 || size % 4 != 0)
    wrong("fill", "offset and size in buffer '" + range.buffer->name() + "' are not multiples of 4");
  impl_->next_step().fillBuffer(*range.buffer->impl().buffer, range.offset_bytes, size, word);
}

void Recorder::copy(const Buffer& from, std::uint64_t from_offset, const Buffer& to, std::uint64_t to_offset,
                    std::uint64_t bytes) {
  if (bytes == 0) return;
  checked_size("copy", {from, from_offset, bytes});
  checked_size("copy", {to, to_offset, bytes});
  if (&from == &to && from_offset < to_offset + bytes && to_offset < from_offset + bytes)
    wrong("copy", "the ranges overlap in buffer '" + from.name() + "'");
  impl_->next_step().copyBuffer(
      *from.impl().buffer, *to.impl().buffer,
      vk::BufferCopy{.srcOffset = from_offset, .dstOffset = to_offset, .size = bytes});
}

void Recorder::submit_and_wait() {
  const bool unfinished = std::exchange(impl_->rendering, nullptr) != nullptr;
  const std::uint32_t steps = std::exchange(impl_->step_count, 0);
  // Freed on every way out: by then the GPU is done with it, or lost.
  const auto freed_afterwards = std::exchange(kept_, {});
  impl_->timings.clear();
  impl_->draw_counts.clear();
  impl_->drawn = false;
  if (steps == 0) return;
  if (unfinished) {
    impl_->drop();
    wrong("recorder", "end_rendering() was not called");
  }
  const std::string doing = "running " + std::to_string(steps) + " recorded steps";
  try {
    translated(doing, [&] {
      record_barrier_to_host(impl_->commands);
      impl_->commands.end();
    });
    impl_->device.native().submit_and_wait(*impl_->commands, doing);
    if (impl_->stopwatch)
      impl_->timings = translated("reading timestamps", [&] { return impl_->stopwatch->take(); });
    if (impl_->device.native().faults.clock_runs_backwards)
      for (Timing& timing : impl_->timings) timing.nanoseconds.reset();
    if (impl_->counters)
      impl_->draw_counts = translated("reading draw statistics", [&] { return impl_->counters->take(); });
  } catch (...) {
    impl_->drop();
    throw;
  }
}

}  // namespace scene_analyzer::gpu
