// vulkan_layer.h — What every Vulkan layer of the tests needs: its place in the loader's chain.
#pragma once

#include <vulkan/vk_layer.h>

namespace scene_analyzer {

// Where the loader says what comes after this layer; null when it says nothing. `Link` is
// VkLayerInstanceCreateInfo or VkLayerDeviceCreateInfo, `Info` what the call was given.
template <typename Link, typename Info>
Link* layer_link(const Info* info, VkStructureType type) {
  for (const void* entry = info->pNext; entry != nullptr;) {
    auto* link = const_cast<Link*>(static_cast<const Link*>(entry));
    if (link->sType == type && link->function == VK_LAYER_LINK_INFO) return link;
    entry = link->pNext;
  }
  return nullptr;
}

inline VkLayerInstanceCreateInfo* layer_link(const VkInstanceCreateInfo* info) {
  return layer_link<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
}
inline VkLayerDeviceCreateInfo* layer_link(const VkDeviceCreateInfo* info) {
  return layer_link<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
}

// `answer` of vkNegotiateLoaderLayerInterfaceVersion. A layer that changes nothing of a device's own has no
// `device_functions`.
inline VkResult answer_loader(VkNegotiateLayerInterface* answer, PFN_vkGetInstanceProcAddr instance_functions,
                              PFN_vkGetDeviceProcAddr device_functions = nullptr) {
  answer->loaderLayerInterfaceVersion = 2;
  answer->pfnGetInstanceProcAddr = instance_functions;
  answer->pfnGetDeviceProcAddr = device_functions;
  answer->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}

}  // namespace scene_analyzer
