#include "gpu/device.h"

#include <spdlog/spdlog.h>

#include <chrono>

#include "gpu/device_info.h"
#include "gpu/device_selection.h"
#include "gpu/error.h"
#include "gpu/native.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::gpu {
namespace {

constexpr std::uint64_t kWaitSliceNanoseconds = 1'000'000'000;
constexpr std::uint32_t kFirstMessageAfterSeconds = 30;

std::unique_ptr<Device::Native> choose(const DeviceOptions& options) {
  auto native =
      std::make_unique<Device::Native>(make_instance(options.validation, options.surface_extensions));
  native->validation = options.validation;
  std::vector<vk::raii::PhysicalDevice> devices = physical_devices(native->instance);
  std::vector<DeviceInfo> infos;
  for (const auto& device : devices)
    infos.push_back(describe_device(device, static_cast<std::uint32_t>(infos.size())));
  const std::size_t chosen = select_device(infos, options.selector);
  native->physical_device = std::move(devices[chosen]);
  native->info = std::move(infos[chosen]);
  return native;
}

vk::raii::Device create_device(const Device::Native& native, bool presents) {
  const float priority = 1;
  const vk::DeviceQueueCreateInfo queue{
      .queueFamilyIndex = native.queue_family, .queueCount = 1, .pQueuePriorities = &priority};
  std::vector<const char*> extensions = {VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};
  if (presents) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  vk::PhysicalDeviceVulkan13Features features13{
      .synchronization2 = true, .dynamicRendering = true, .maintenance4 = true};
  // What is not asked for in refusals_of(), every device of Vulkan 1.3 has.
  vk::PhysicalDeviceVulkan12Features features12{.pNext = &features13,
                                                .scalarBlockLayout = true,
                                                .shaderSubgroupExtendedTypes = true,
                                                .hostQueryReset = true};
  const vk::PhysicalDeviceFeatures2 features{
      .pNext = &features12,
      .features = {.fullDrawIndexUint32 = native.physical_device.getFeatures().fullDrawIndexUint32,
                   .geometryShader = native.info.numbers_triangles,
                   .fillModeNonSolid = native.info.draws_wireframes,
                   .pipelineStatisticsQuery = native.info.counts_invocations,
                   .shaderFloat64 = true,
                   .shaderInt64 = true}};
  vk::DeviceCreateInfo info{.pNext = &features, .queueCreateInfoCount = 1, .pQueueCreateInfos = &queue};
  info.setPEnabledExtensionNames(extensions);
  return {native.physical_device, info};
}

void create_objects(Device::Native& native, const DeviceOptions& options) {
  const vk::PhysicalDeviceProperties properties = native.physical_device.getProperties();
  native.limits = properties.limits;
  native.memory_types = MemoryTypes(native.physical_device.getMemoryProperties(), native.info.type);
  native.queue_family = choose_queue_family(native.physical_device).value();
  if (!options.surface_extensions.empty() && !can_present(native.physical_device))
    throw Error("device " + native.info.name +
                " cannot show pictures in a window (VK_KHR_swapchain is missing)");
  native.device = create_device(native, !options.surface_extensions.empty());
  native.queue = native.device.getQueue(native.queue_family, 0);
  native.command_pool = {
      native.device, vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                               .queueFamilyIndex = native.queue_family}};
  native.fence = {native.device, vk::FenceCreateInfo{}};
  native.cache_folder = options.cache_folder;
  native.pipeline_cache = PipelineCache(native.device, properties, options.cache_folder);
}

// A long dispatch is legal, a silent hang is not: says every now and then, ever more rarely, that it still
// waits.
void wait_for_fence(const Device::Native& native, const std::string& doing) {
  std::uint32_t seconds = 0;
  std::uint32_t next_message = kFirstMessageAfterSeconds;
  while (native.device.waitForFences(*native.fence, true, kWaitSliceNanoseconds) == vk::Result::eTimeout) {
    if (++seconds < next_message) continue;
    spdlog::warn("the GPU has been busy for {} s, {}", seconds, doing);
    next_message *= 2;
  }
}

void submit(Device::Native& native, vk::CommandBuffer commands) {
  native.device.resetFences(*native.fence);
  const vk::CommandBufferSubmitInfo buffer{.commandBuffer = commands};
  native.queue.submit2(vk::SubmitInfo2{.commandBufferInfoCount = 1, .pCommandBufferInfos = &buffer},
                       *native.fence);
}

}  // namespace

void Device::Native::submit_and_wait(vk::CommandBuffer commands, const std::string& doing) {
  if (std::exchange(faults.lose_device_at_next_submit, false)) lost = true;
  if (lost) throw DeviceLost(device_lost_message(doing));
  try {
    submit(*this, commands);
    try {
      wait_for_fence(*this, doing);
    } catch (const vk::DeviceLostError&) {
      throw;
    } catch (const vk::SystemError&) {
      device.waitIdle();  // the caller is about to free what the GPU may still be using
      throw;
    }
  } catch (const vk::DeviceLostError&) {
    lost = true;
    throw DeviceLost(device_lost_message(doing));
  } catch (const vk::SystemError&) {
    rethrow_as_gpu_error(doing);
  }
}

vk::raii::CommandBuffer Device::Native::make_commands() {
  return translated("making a command buffer", [&] {
    vk::raii::CommandBuffers made(
        device,
        {.commandPool = *command_pool, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1});
    return std::move(made.front());
  });
}

void Device::Native::set_name(vk::ObjectType type, std::uint64_t handle, const std::string& name) const {
  if (!validation) return;
  translated("naming '" + name + "'", [&] {
    device.setDebugUtilsObjectNameEXT(
        {.objectType = type, .objectHandle = handle, .pObjectName = name.c_str()});
  });
}

Device::Device(const DeviceOptions& options) : native_(choose(options)) {
  translated("opening device " + native_->info.name, [&] { create_objects(*native_, options); });
}

Device::~Device() {
  if (native_->lost) return;  // a dead driver's cache is not worth keeping
  try {
    native_->pipeline_cache.save();
  } catch (const std::exception& error) {  // only the next start is slower
    spdlog::warn("{}", error.what());
  }
}

const DeviceInfo& Device::info() const {
  return native_->info;
}
std::uint64_t Device::buffer_bytes() const {
  return native_->buffer_bytes;
}
std::uint64_t Device::peak_buffer_bytes() const {
  return native_->peak_buffer_bytes;
}
void Device::reset_peak() {
  native_->peak_buffer_bytes = native_->buffer_bytes;
}
std::vector<std::string> Device::take_validation_messages() {
  return native_->instance.log->take();
}

}  // namespace scene_analyzer::gpu
