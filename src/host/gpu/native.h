// native.h — The one marked door to Vulkan: the handles behind Device, Buffer and Kernel.
//
// Included by gpu/*.cpp and by spectrum/, which must talk Vulkan itself (FFT), and
// never by a header of another room: vulkan_raii.hpp costs four seconds per translation unit.
#pragma once

#define VULKAN_HPP_NO_CONSTRUCTORS
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vulkan/vulkan_raii.hpp>

#include "gpu/device.h"
#include "gpu/draw_counters.h"
#include "gpu/faults.h"
#include "gpu/instance.h"
#include "gpu/memory.h"
#include "gpu/pipeline_cache.h"
#include "gpu/recorder.h"
#include "gpu/stopwatch.h"

namespace scene_analyzer::gpu {

struct Buffer::Impl {
  Device::Native& device;
  std::string name;
  std::uint64_t bytes = 0;  // counted in the device's buffer_bytes
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::Buffer buffer{nullptr};
  std::byte* mapped =
      nullptr;  // host address of the whole buffer, coherent; null where the host cannot reach it

  Impl(Device::Native& owner, std::string buffer_name) : device(owner), name(std::move(buffer_name)) {}
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
};

// Members are destroyed from the last to the first, so each stands below what it needs.
struct Device::Native {
  explicit Native(Instance made) : instance(std::move(made)) {}

  Instance instance;
  vk::raii::PhysicalDevice physical_device{nullptr};
  DeviceInfo info;
  vk::PhysicalDeviceLimits limits;
  MemoryTypes memory_types;
  std::uint32_t queue_family = 0;  // compute, and graphics too where one family has both
  bool validation = false;
  bool lost = false;               // every later submission throws DeviceLost
  Faults faults;                   // tests only
  std::uint64_t buffer_bytes = 0;  // staging not counted
  std::uint64_t peak_buffer_bytes = 0;

  vk::raii::Device device{nullptr};
  vk::raii::Queue queue{nullptr};
  vk::raii::CommandPool command_pool{nullptr};  // command buffers can be reset one by one
  vk::raii::Fence fence{nullptr};               // one is enough: submissions are synchronous
  PipelineCache pipeline_cache;
  std::optional<std::filesystem::path> cache_folder;  // where files that save time are kept; absent: nowhere
  vk::raii::Sampler sampler{nullptr};                 // of all textures, made with the first one
  std::unique_ptr<Buffer::Impl> staging{};            // host-visible, made at the first copy that needs it

  // The only way to the queue: submits the ended commands, waits in slices with a message when it takes long,
  // and turns every result into an exception of the gpu room. `doing` goes into that message: "running 12
  // dispatches".
  void submit_and_wait(vk::CommandBuffer commands, const std::string& doing);
  vk::raii::CommandBuffer make_commands();
  // Shown by the validation layer and by debuggers; does nothing without validation.
  void set_name(vk::ObjectType type, std::uint64_t handle, const std::string& name) const;
};

inline Buffer::Impl::~Impl() {
  device.buffer_bytes -= bytes;
}

struct Kernel::Impl {
  std::string name;
  std::uint32_t local_size = 0;
  std::uint32_t buffer_count = 0;
  std::uint32_t push_constant_bytes = 0;
  vk::raii::DescriptorSetLayout set_layout{nullptr};
  vk::raii::PipelineLayout layout{nullptr};
  vk::raii::Pipeline pipeline{nullptr};
};

inline constexpr vk::Format kColorFormat = vk::Format::eR8G8B8A8Unorm;
inline constexpr vk::Format kDepthFormat = vk::Format::eD32Sfloat;
// 1, 2, 4, ...: the bits are the numbers.
inline vk::SampleCountFlagBits sample_count(std::uint32_t samples) {
  return static_cast<vk::SampleCountFlagBits>(samples);
}
inline constexpr vk::ShaderStageFlags kDrawStages =
    vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;

// A CPU device's driver grants what the kernel would later kill this process for: throws OutOfMemory instead.
void check_free_memory(const DeviceInfo& info, const std::string& what, std::uint64_t bytes);

// An image with memory of its own, and a view of all of it.
struct Image {
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::Image image{nullptr};
  vk::raii::ImageView view{nullptr};
};
// Two-dimensional, of one layer; `aspect` is what the view shows. Throws vk::SystemError, Error, OutOfMemory.
Image make_image(Device::Native& native, vk::ImageCreateInfo info, vk::ImageAspectFlags aspect);
// From whatever was recorded before to whatever comes after, all levels.
vk::ImageMemoryBarrier2 change_layout(const Image& image, vk::ImageAspectFlags aspect, vk::ImageLayout from,
                                      vk::ImageLayout to);
void record_layouts(const vk::raii::CommandBuffer& commands,
                    std::initializer_list<vk::ImageMemoryBarrier2> changes);

struct RenderTarget::Impl {
  std::string name;
  vk::Extent2D extent;
  std::uint32_t samples = 1;
  Image color, depth;
  Image resolved;  // of several samples: what copy_color() copies
};

struct Texture::Impl {
  std::string name;
  Image image;
};

struct RasterPipeline::Impl {
  std::string name;
  std::vector<std::uint32_t> strides;  // of the vertex shader's inputs, bytes
  std::uint32_t push_constant_bytes = 0;
  bool reads_texture = false;
  std::uint32_t buffer_count = 0;
  std::uint32_t samples = 1;
  vk::raii::DescriptorSetLayout set_layout{nullptr};
  vk::raii::PipelineLayout layout{nullptr};
  vk::raii::Pipeline pipeline{nullptr};
};

struct Recorder::Impl {
  Device& device;
  vk::raii::CommandBuffer commands;
  std::optional<Stopwatch> stopwatch;    // with `profile`, where the queue has timestamps
  std::optional<DrawCounters> counters;  // with count_invocations(), where the device has them
  std::vector<Recorder::Timing> timings;
  std::vector<Recorder::DrawCounts> draw_counts;
  const RenderTarget::Impl* rendering = nullptr;  // between begin_rendering() and end_rendering()
  bool clipped = false;                           // the last draw had a clip
  bool drawn = false;                             // since the last barrier that waits for draws
  std::uint32_t step_count = 0;  // dispatches, fills and copies recorded; 0: the recording has not begun

  Impl(Device& owner, bool profile);
  void drop();
  // Begins the recording where needed and inserts the barrier against everything before: commands recorded
  // into the result (compute and transfer stages) need no barrier of their own before the first of them.
  const vk::raii::CommandBuffer& next_step();
};

inline constexpr vk::ImageSubresourceLayers kWholeColor = {.aspectMask = vk::ImageAspectFlagBits::eColor,
                                                           .layerCount = 1};
// Lets `use` record reads of the colours of a target that was rendered to, one sample per pixel, which lie as
// eTransferSrcOptimal.
void record_with_color(const vk::raii::CommandBuffer& commands, const RenderTarget::Impl& images,
                       const std::function<void(const vk::raii::Image&)>& use);
// Every step may read and write what any earlier compute or transfer command wrote, in this submission or
// before.
void record_barrier(const vk::raii::CommandBuffer& commands);
// The same after and before draws, and images.
void record_barrier_for_drawing(const vk::raii::CommandBuffer& commands);
// Makes everything written readable through mapped memory after the fence.
void record_barrier_to_host(const vk::raii::CommandBuffer& commands);

// For wrong use by the program itself: throws std::logic_error.
[[noreturn]] void wrong(const std::string& where, const std::string& what);

enum class BufferKind { kStorage, kVertex, kStaging };
// `bytes` as they are; throws OutOfMemory.
std::unique_ptr<Buffer::Impl> make_buffer_impl(Device::Native& native, const std::string& name,
                                               std::uint64_t bytes, BufferKind kind);

}  // namespace scene_analyzer::gpu
