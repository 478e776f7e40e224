// vkfft_calls.h — What VkFFT calls in place of the Vulkan loader's functions. For vkfft_plan.cpp alone, in
// front of VkFFT's header.
//
// VkFFT is C and calls vkCreateBuffer() and the like by name. This program is not linked against the loader
// (it is opened at run time), submissions have to go through Device::Native, and pipelines through its cache.
// So those names become macros that lead to the device's own table of functions, or to a function below. Each
// place of VkFFT that calls one has the application `app` in scope, and with it the pointer to a VkDevice
// that it was given: a VkfftDevice.
#pragma once

#include <spdlog/spdlog.h>

#include <algorithm>
#include <clocale>
#include <cstdarg>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "gpu/error.h"
#include "gpu/native.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::spectrum {

// What one VkFFT application works with, and what it left behind.
struct VkfftHost {
  gpu::Device::Native& native;
  std::exception_ptr failure{};  // behind an error code that VkFFT got
  std::vector<VkBuffer> buffers{};
  std::vector<VkDeviceMemory> memory{};

  explicit VkfftHost(gpu::Device::Native& owner) : native(owner) {}
  // VkFFT forgets a buffer or two when an allocation fails.
  ~VkfftHost() {
    for (VkBuffer buffer : buffers) calls().vkDestroyBuffer(*native.device, buffer, nullptr);
    for (VkDeviceMemory block : memory) calls().vkFreeMemory(*native.device, block, nullptr);
  }
  VkfftHost(const VkfftHost&) = delete;
  VkfftHost& operator=(const VkfftHost&) = delete;

  const vk::raii::DeviceDispatcher& calls() const { return *native.device.getDispatcher(); }
};

// VkFFT is handed the address of `handle`.
struct VkfftDevice {
  VkDevice handle;
  VkfftHost* host;
};

inline VkResult create_buffer(VkfftHost& host, const VkBufferCreateInfo* info, VkBuffer* made) {
  const VkResult result = host.calls().vkCreateBuffer(*host.native.device, info, nullptr, made);
  if (result == VK_SUCCESS) host.buffers.push_back(*made);
  return result;
}

inline void destroy_buffer(VkfftHost& host, VkBuffer buffer) {
  std::erase(host.buffers, buffer);
  host.calls().vkDestroyBuffer(*host.native.device, buffer, nullptr);
}

inline VkResult allocate_memory(VkfftHost& host, const VkMemoryAllocateInfo* info, VkDeviceMemory* made) {
  const VkResult result = gpu::allocation_fails(host.native.faults)
                              ? VK_ERROR_OUT_OF_DEVICE_MEMORY
                              : host.calls().vkAllocateMemory(*host.native.device, info, nullptr, made);
  if (result == VK_SUCCESS)
    host.memory.push_back(*made);
  else
    host.failure = std::make_exception_ptr(
        gpu::OutOfMemory("tables of a Fourier transform need " + std::to_string(info->allocationSize) +
                         " bytes, but the driver refused them with " +
                         std::to_string(host.native.buffer_bytes) + " bytes in use by buffers"));
  return result;
}

inline void free_memory(VkfftHost& host, VkDeviceMemory block) {
  std::erase(host.memory, block);
  host.calls().vkFreeMemory(*host.native.device, block, nullptr);
}

// VkFFT has codes of its own for what fails, which do not tell a lack of memory from a defect.
inline VkResult noted(VkfftHost& host, VkResult result) {
  if (result >= VK_SUCCESS || host.failure) return result;
  const std::string doing = "planning a Fourier transform";
  if (result == VK_ERROR_DEVICE_LOST)
    host.failure = std::make_exception_ptr(gpu::DeviceLost(gpu::device_lost_message(doing)));
  if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY ||
      result == VK_ERROR_OUT_OF_POOL_MEMORY)
    host.failure =
        std::make_exception_ptr(gpu::OutOfMemory("the GPU driver ran out of memory while " + doing));
  return result;
}

// Submits and waits, so that VkFFT's own waiting and resetting of the fence has nothing left to do.
inline VkResult submit_and_wait(VkfftHost& host, const VkSubmitInfo* info) {
  try {
    host.native.submit_and_wait(info->pCommandBuffers[0], "uploading tables of a Fourier transform");
    return VK_SUCCESS;
  } catch (const gpu::Error&) {
    host.failure = std::current_exception();
    return VK_ERROR_DEVICE_LOST;
  }
}

// Buffers are shorter than what the plan could hold; bindings 0 and 1 are the rows, before and after.
inline void update_descriptors(VkfftHost& host, VkWriteDescriptorSet write) {
  VkDescriptorBufferInfo buffer = *write.pBufferInfo;
  if (write.dstBinding < 2) buffer.range = VK_WHOLE_SIZE;
  write.pBufferInfo = &buffer;
  host.calls().vkUpdateDescriptorSets(*host.native.device, 1, &write, 0, nullptr);
}

// VkFFT prints to the standard output, where this program writes reports.
[[gnu::format(printf, 1, 2)]] inline void log_message(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  char text[512];
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  spdlog::debug("VkFFT: {}", text);
}

// Numbers in generated GLSL have a decimal point in every locale. VkFFT's own way is to change the locale of
// the whole process for a while, and back to a name that is no longer valid then.
class ClassicLocale {
 public:
  ClassicLocale() : classic_(::newlocale(LC_ALL_MASK, "C", nullptr)), before_(::uselocale(classic_)) {}
  ~ClassicLocale() {
    ::uselocale(before_);
    ::freelocale(classic_);
  }
  ClassicLocale(const ClassicLocale&) = delete;
  ClassicLocale& operator=(const ClassicLocale&) = delete;

 private:
  locale_t classic_, before_;
};

}  // namespace scene_analyzer::spectrum

// NOLINTBEGIN(bugprone-macro-parentheses)
#define printf(...) scene_analyzer::spectrum::log_message(__VA_ARGS__)
#define setlocale(category, name) (static_cast<const char*>(nullptr))

#define VKFFT_HOST \
  (*reinterpret_cast<const scene_analyzer::spectrum::VkfftDevice*>(app->configuration.device)->host)
#define VKFFT_CALL(name) VKFFT_HOST.calls().name

#define vkCreateBuffer(device, info, allocator, made) create_buffer(VKFFT_HOST, info, made)
#define vkDestroyBuffer(device, buffer, allocator) destroy_buffer(VKFFT_HOST, buffer)
#define vkAllocateMemory(device, info, allocator, made) allocate_memory(VKFFT_HOST, info, made)
#define vkFreeMemory(device, block, allocator) free_memory(VKFFT_HOST, block)
#define vkQueueSubmit(queue, count, info, fence) submit_and_wait(VKFFT_HOST, info)
#define vkWaitForFences(device, count, fences, all, timeout) VK_SUCCESS
#define vkResetFences(device, count, fences) VK_SUCCESS
#define vkUpdateDescriptorSets(device, count, writes, copies, copied) \
  update_descriptors(VKFFT_HOST, *(writes))
#define VKFFT_NOTED(name, ...) noted(VKFFT_HOST, VKFFT_CALL(name)(__VA_ARGS__))
#define vkCreateComputePipelines(device, cache, count, infos, allocator, made)                            \
  VKFFT_NOTED(vkCreateComputePipelines, device, *VKFFT_HOST.native.pipeline_cache.handle(), count, infos, \
              allocator, made)
#define vkGetPhysicalDeviceProperties(device, out) \
  (*(out) = VKFFT_HOST.native.physical_device.getProperties())
#define vkGetPhysicalDeviceMemoryProperties(device, out) \
  (*(out) = VKFFT_HOST.native.physical_device.getMemoryProperties())

#define vkAllocateCommandBuffers(...) VKFFT_NOTED(vkAllocateCommandBuffers, __VA_ARGS__)
#define vkAllocateDescriptorSets(...) VKFFT_NOTED(vkAllocateDescriptorSets, __VA_ARGS__)
#define vkBeginCommandBuffer(...) VKFFT_NOTED(vkBeginCommandBuffer, __VA_ARGS__)
#define vkBindBufferMemory(...) VKFFT_NOTED(vkBindBufferMemory, __VA_ARGS__)
#define vkCmdBindDescriptorSets VKFFT_CALL(vkCmdBindDescriptorSets)
#define vkCmdBindPipeline VKFFT_CALL(vkCmdBindPipeline)
#define vkCmdCopyBuffer VKFFT_CALL(vkCmdCopyBuffer)
#define vkCmdDispatch VKFFT_CALL(vkCmdDispatch)
#define vkCmdPipelineBarrier VKFFT_CALL(vkCmdPipelineBarrier)
#define vkCmdPushConstants VKFFT_CALL(vkCmdPushConstants)
#define vkCreateDescriptorPool(...) VKFFT_NOTED(vkCreateDescriptorPool, __VA_ARGS__)
#define vkCreateDescriptorSetLayout(...) VKFFT_NOTED(vkCreateDescriptorSetLayout, __VA_ARGS__)
#define vkCreatePipelineLayout(...) VKFFT_NOTED(vkCreatePipelineLayout, __VA_ARGS__)
#define vkCreateShaderModule(...) VKFFT_NOTED(vkCreateShaderModule, __VA_ARGS__)
#define vkDestroyDescriptorPool VKFFT_CALL(vkDestroyDescriptorPool)
#define vkDestroyDescriptorSetLayout VKFFT_CALL(vkDestroyDescriptorSetLayout)
#define vkDestroyPipeline VKFFT_CALL(vkDestroyPipeline)
#define vkDestroyPipelineLayout VKFFT_CALL(vkDestroyPipelineLayout)
#define vkDestroyShaderModule VKFFT_CALL(vkDestroyShaderModule)
#define vkEndCommandBuffer(...) VKFFT_NOTED(vkEndCommandBuffer, __VA_ARGS__)
#define vkFreeCommandBuffers VKFFT_CALL(vkFreeCommandBuffers)
#define vkGetBufferMemoryRequirements VKFFT_CALL(vkGetBufferMemoryRequirements)
#define vkMapMemory(...) VKFFT_NOTED(vkMapMemory, __VA_ARGS__)
#define vkUnmapMemory VKFFT_CALL(vkUnmapMemory)
// NOLINTEND(bugprone-macro-parentheses)
