// small_device_layer.cpp — A Vulkan layer between the program and the real device: it says that buffers can
// bind little, so that a small asset is beyond the device. Real devices begin at 128 MiB, which takes ten
// million triangles to exceed. The program is the one users run and knows nothing of it.
//
// Vulkan's loader puts the layer in where its environment variables say so. One instance at a time.
#include <algorithm>
#include <cstring>

#include "cli/small_device.h"
#include "support/vulkan_layer.h"

namespace {

PFN_vkGetInstanceProcAddr next_get_instance_proc_addr = nullptr;
PFN_vkGetPhysicalDeviceProperties next_properties = nullptr;
PFN_vkGetPhysicalDeviceProperties2 next_properties2 = nullptr;

void shrink(VkPhysicalDeviceProperties& properties) {
  properties.limits.maxStorageBufferRange =
      std::min(properties.limits.maxStorageBufferRange, scene_analyzer::kSmallDeviceBufferBytes);
}

VKAPI_ATTR void VKAPI_CALL get_properties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties) {
  next_properties(device, properties);
  shrink(*properties);
}

VKAPI_ATTR void VKAPI_CALL get_properties2(VkPhysicalDevice device, VkPhysicalDeviceProperties2* properties) {
  next_properties2(device, properties);
  shrink(properties->properties);
}

template <typename Function>
Function next(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(next_get_instance_proc_addr(instance, name));
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkInstance* instance) {
  VkLayerInstanceCreateInfo* link = scene_analyzer::layer_link(info);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  next_get_instance_proc_addr = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;  // for the next layer, which reads the same entry
  const VkResult result = next<PFN_vkCreateInstance>(nullptr, "vkCreateInstance")(info, allocator, instance);
  if (result != VK_SUCCESS) return result;
  next_properties = next<PFN_vkGetPhysicalDeviceProperties>(*instance, "vkGetPhysicalDeviceProperties");
  next_properties2 = next<PFN_vkGetPhysicalDeviceProperties2>(*instance, "vkGetPhysicalDeviceProperties2");
  return VK_SUCCESS;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_proc_addr(VkInstance instance, const char* name) {
  const auto is = [name](const char* other) { return std::strcmp(name, other) == 0; };
  if (is("vkGetInstanceProcAddr")) return reinterpret_cast<PFN_vkVoidFunction>(get_instance_proc_addr);
  if (is("vkCreateInstance")) return reinterpret_cast<PFN_vkVoidFunction>(create_instance);
  if (is("vkGetPhysicalDeviceProperties")) return reinterpret_cast<PFN_vkVoidFunction>(get_properties);
  if (is("vkGetPhysicalDeviceProperties2")) return reinterpret_cast<PFN_vkVoidFunction>(get_properties2);
  return next_get_instance_proc_addr == nullptr ? nullptr : next_get_instance_proc_addr(instance, name);
}

}  // namespace

extern "C" VK_LAYER_EXPORT VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* answer) {
  return scene_analyzer::answer_loader(answer, get_instance_proc_addr);
}
