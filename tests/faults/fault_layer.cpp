// fault_layer.cpp — A Vulkan layer between the program and the device that makes chosen calls fail at a
// chosen time, as fault_rules.h says. The program is the one users run and knows nothing of it.
//
// A call that fails is not passed on, but for the wait whose device is lost: its work is finished first,
// because what it uses is freed next. A lost device stays lost.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <type_traits>

#include "faults/fault_rules.h"
#include "support/vulkan_layer.h"

namespace {

using scene_analyzer::faults::Fault;

const char* variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::vector<scene_analyzer::faults::Rule> rules_of_environment() {
  try {
    return scene_analyzer::faults::parse_rules(variable(scene_analyzer::faults::kRulesVariable));
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s: %s\n", scene_analyzer::faults::kRulesVariable, error.what());
    std::abort();  // a test that fails nothing would pass
  }
}

// The loader and the handles of one instance or device have the same first word.
template <typename Handle>
void* key_of(Handle handle) {
  return *reinterpret_cast<void**>(handle);
}

struct NextOfInstance {
  VkInstance instance = nullptr;
  PFN_vkGetInstanceProcAddr functions = nullptr;
  // Asked for while the instance is made: later the loader answers with this layer's own.
  PFN_vkGetPhysicalDeviceSurfaceSupportKHR surface_support = nullptr;
  PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR surface_capabilities = nullptr;

  NextOfInstance() = default;
  NextOfInstance(VkInstance made, PFN_vkGetInstanceProcAddr next) : instance(made), functions(next) {
    find(surface_support, "vkGetPhysicalDeviceSurfaceSupportKHR");
    find(surface_capabilities, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  }

  template <typename Function>
  void find(Function& function, const char* name) const {
    function = reinterpret_cast<Function>(functions(instance, name));
  }
};
struct NextOfDevice {
  VkDevice device = nullptr;
  PFN_vkGetDeviceProcAddr functions = nullptr;
  bool lost = false;
};

struct State {
  std::mutex mutex;
  scene_analyzer::faults::Plan plan{rules_of_environment()};
  std::map<void*, NextOfInstance> instances;
  std::map<void*, NextOfDevice> devices;

  ~State() {
    const std::string file = variable(scene_analyzer::faults::kCountsVariable);
    if (file.empty()) return;
    std::ofstream stream(file);
    for (const auto& [function, count] : plan.counts()) stream << function << ' ' << count << '\n';
  }
};

State state;

VkResult result_of(Fault fault) {
  switch (fault) {
    case Fault::kDeviceLost:
      return VK_ERROR_DEVICE_LOST;
    case Fault::kOutOfDeviceMemory:
      return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    case Fault::kOutOfHostMemory:
      return VK_ERROR_OUT_OF_HOST_MEMORY;
    case Fault::kOutOfDate:
      return VK_ERROR_OUT_OF_DATE_KHR;
    case Fault::kSuboptimal:
      return VK_SUBOPTIMAL_KHR;
    case Fault::kSurfaceLost:
      return VK_ERROR_SURFACE_LOST_KHR;
    case Fault::kTimeout:
      return VK_TIMEOUT;
    case Fault::kFalse:
    case Fault::kZeroExtent:
      return VK_SUCCESS;  // what the call answers is changed instead
  }
  return VK_ERROR_UNKNOWN;
}

// Calls that a lost device answers with nothing else.
bool shows_loss(const std::string& function) {
  static const std::set<std::string> kFunctions = {"vkQueueSubmit",     "vkQueueSubmit2",
                                                   "vkWaitForFences",   "vkAcquireNextImageKHR",
                                                   "vkQueuePresentKHR", "vkDeviceWaitIdle"};
  return kFunctions.contains(function);
}

// The name of a function as a template's argument.
template <std::size_t kSize>
struct Name {
  char text[kSize]{};
  constexpr Name(const char (&name)[kSize]) {  // NOLINT(google-explicit-constructor): written as "text"
    for (std::size_t i = 0; i < kSize; ++i) text[i] = name[i];
  }
};

template <Name kName, typename Function>
struct OfDevice;

// A call of a device, or of what belongs to one, that may fail.
template <Name kName, typename Handle, typename... Arguments>
struct OfDevice<kName, VkResult (*)(Handle, Arguments...)> {
  using Function = VkResult (*)(Handle, Arguments...);

  static VKAPI_ATTR VkResult VKAPI_CALL call(Handle handle, Arguments... arguments) {
    const std::string name = kName.text;
    NextOfDevice next;
    std::optional<Fault> fault;
    {
      const std::scoped_lock lock(state.mutex);
      NextOfDevice& device = state.devices.at(key_of(handle));
      fault = state.plan.next_call(name);
      if (device.lost && shows_loss(name)) fault = Fault::kDeviceLost;
      if (fault == Fault::kDeviceLost) device.lost = true;
      next = device;
    }
    const auto pass_on = [&] {
      return reinterpret_cast<Function>(next.functions(next.device, kName.text))(handle, arguments...);
    };
    if (!fault) return pass_on();
    if (fault == Fault::kSuboptimal) {  // done all the same
      const VkResult result = pass_on();
      return result == VK_SUCCESS ? VK_SUBOPTIMAL_KHR : result;
    }
    if (fault == Fault::kTimeout) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    if (fault == Fault::kDeviceLost && name == "vkWaitForFences") {
      const auto wait =
          reinterpret_cast<PFN_vkDeviceWaitIdle>(next.functions(next.device, "vkDeviceWaitIdle"));
      wait(next.device);
    }
    return result_of(*fault);
  }
};

template <Name kName, typename Function>
PFN_vkVoidFunction of_device() {
  static_assert(std::is_pointer_v<Function>);
  return reinterpret_cast<PFN_vkVoidFunction>(OfDevice<kName, Function>::call);
}

NextOfInstance next_of(VkPhysicalDevice device) {
  const std::scoped_lock lock(state.mutex);
  return state.instances.at(key_of(device));
}

std::optional<Fault> fault_of(const char* name) {
  const std::scoped_lock lock(state.mutex);
  return state.plan.next_call(name);
}

VKAPI_ATTR VkResult VKAPI_CALL surface_support(VkPhysicalDevice device, std::uint32_t family,
                                               VkSurfaceKHR surface, VkBool32* supported) {
  const auto fault = fault_of("vkGetPhysicalDeviceSurfaceSupportKHR");
  if (fault && *fault != Fault::kFalse) return result_of(*fault);
  const VkResult result = next_of(device).surface_support(device, family, surface, supported);
  if (fault) *supported = VK_FALSE;
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL surface_capabilities(VkPhysicalDevice device, VkSurfaceKHR surface,
                                                    VkSurfaceCapabilitiesKHR* capabilities) {
  const auto fault = fault_of("vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  if (fault && *fault != Fault::kZeroExtent) return result_of(*fault);
  const VkResult result = next_of(device).surface_capabilities(device, surface, capabilities);
  if (fault)
    capabilities->currentExtent = capabilities->minImageExtent = capabilities->maxImageExtent = {0, 0};
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkInstance* instance) {
  VkLayerInstanceCreateInfo* link = scene_analyzer::layer_link(info);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  const PFN_vkGetInstanceProcAddr functions = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;  // for the next layer, which reads the same entry
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(functions(nullptr, "vkCreateInstance"));
  const VkResult result = create(info, allocator, instance);
  if (result != VK_SUCCESS) return result;
  const std::scoped_lock lock(state.mutex);
  state.instances[key_of(*instance)] = NextOfInstance(*instance, functions);
  return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical_device, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator, VkDevice* device) {
  VkLayerDeviceCreateInfo* link = scene_analyzer::layer_link(info);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  if (const auto fault = fault_of("vkCreateDevice")) return result_of(*fault);
  const PFN_vkGetDeviceProcAddr functions = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  const PFN_vkGetInstanceProcAddr of_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  NextOfInstance owner;
  {
    const std::scoped_lock lock(state.mutex);
    owner = state.instances.at(key_of(physical_device));
  }
  const auto create = reinterpret_cast<PFN_vkCreateDevice>(of_instance(owner.instance, "vkCreateDevice"));
  const VkResult result = create(physical_device, info, allocator, device);
  if (result != VK_SUCCESS) return result;
  const std::scoped_lock lock(state.mutex);
  state.devices[key_of(*device)] = {.device = *device, .functions = functions};
  return VK_SUCCESS;
}

PFN_vkVoidFunction device_call(const std::string& name) {
  static const std::map<std::string, PFN_vkVoidFunction> kCalls = {
      {"vkQueueSubmit", of_device<"vkQueueSubmit", PFN_vkQueueSubmit>()},
      {"vkQueueSubmit2", of_device<"vkQueueSubmit2", PFN_vkQueueSubmit2>()},
      {"vkWaitForFences", of_device<"vkWaitForFences", PFN_vkWaitForFences>()},
      {"vkDeviceWaitIdle", of_device<"vkDeviceWaitIdle", PFN_vkDeviceWaitIdle>()},
      {"vkAllocateMemory", of_device<"vkAllocateMemory", PFN_vkAllocateMemory>()},
      {"vkMapMemory", of_device<"vkMapMemory", PFN_vkMapMemory>()},
      {"vkBindBufferMemory", of_device<"vkBindBufferMemory", PFN_vkBindBufferMemory>()},
      {"vkCreateBuffer", of_device<"vkCreateBuffer", PFN_vkCreateBuffer>()},
      {"vkCreateImage", of_device<"vkCreateImage", PFN_vkCreateImage>()},
      {"vkCreateImageView", of_device<"vkCreateImageView", PFN_vkCreateImageView>()},
      {"vkCreateQueryPool", of_device<"vkCreateQueryPool", PFN_vkCreateQueryPool>()},
      {"vkCreateFence", of_device<"vkCreateFence", PFN_vkCreateFence>()},
      {"vkCreateCommandPool", of_device<"vkCreateCommandPool", PFN_vkCreateCommandPool>()},
      {"vkAllocateCommandBuffers", of_device<"vkAllocateCommandBuffers", PFN_vkAllocateCommandBuffers>()},
      {"vkBeginCommandBuffer", of_device<"vkBeginCommandBuffer", PFN_vkBeginCommandBuffer>()},
      {"vkEndCommandBuffer", of_device<"vkEndCommandBuffer", PFN_vkEndCommandBuffer>()},
      {"vkCreateShaderModule", of_device<"vkCreateShaderModule", PFN_vkCreateShaderModule>()},
      {"vkCreatePipelineCache", of_device<"vkCreatePipelineCache", PFN_vkCreatePipelineCache>()},
      {"vkCreatePipelineLayout", of_device<"vkCreatePipelineLayout", PFN_vkCreatePipelineLayout>()},
      {"vkCreateDescriptorSetLayout",
       of_device<"vkCreateDescriptorSetLayout", PFN_vkCreateDescriptorSetLayout>()},
      {"vkCreateDescriptorPool", of_device<"vkCreateDescriptorPool", PFN_vkCreateDescriptorPool>()},
      {"vkAllocateDescriptorSets", of_device<"vkAllocateDescriptorSets", PFN_vkAllocateDescriptorSets>()},
      {"vkCreateComputePipelines", of_device<"vkCreateComputePipelines", PFN_vkCreateComputePipelines>()},
      {"vkCreateGraphicsPipelines", of_device<"vkCreateGraphicsPipelines", PFN_vkCreateGraphicsPipelines>()},
      {"vkCreateSwapchainKHR", of_device<"vkCreateSwapchainKHR", PFN_vkCreateSwapchainKHR>()},
      {"vkAcquireNextImageKHR", of_device<"vkAcquireNextImageKHR", PFN_vkAcquireNextImageKHR>()},
      {"vkQueuePresentKHR", of_device<"vkQueuePresentKHR", PFN_vkQueuePresentKHR>()},
  };
  const auto call = kCalls.find(name);
  return call == kCalls.end() ? nullptr : call->second;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_proc_addr(VkDevice device, const char* name) {
  if (std::string(name) == "vkGetDeviceProcAddr")
    return reinterpret_cast<PFN_vkVoidFunction>(get_device_proc_addr);
  const std::scoped_lock lock(state.mutex);
  const NextOfDevice& next = state.devices.at(key_of(device));
  const PFN_vkVoidFunction below = next.functions(next.device, name);
  const PFN_vkVoidFunction call = device_call(name);
  return call != nullptr && below != nullptr ? call : below;  // extensions that are off stay so
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_proc_addr(VkInstance instance, const char* name) {
  const std::string wanted = name;
  if (wanted == "vkGetInstanceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(get_instance_proc_addr);
  if (wanted == "vkGetDeviceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(get_device_proc_addr);
  if (wanted == "vkCreateInstance") return reinterpret_cast<PFN_vkVoidFunction>(create_instance);
  if (wanted == "vkCreateDevice") return reinterpret_cast<PFN_vkVoidFunction>(create_device);
  if (instance == nullptr) return nullptr;
  if (wanted == "vkGetPhysicalDeviceSurfaceSupportKHR")
    return reinterpret_cast<PFN_vkVoidFunction>(surface_support);
  if (wanted == "vkGetPhysicalDeviceSurfaceCapabilitiesKHR")
    return reinterpret_cast<PFN_vkVoidFunction>(surface_capabilities);
  if (const PFN_vkVoidFunction call = device_call(wanted)) return call;
  const std::scoped_lock lock(state.mutex);
  const auto next = state.instances.find(key_of(instance));
  return next == state.instances.end() ? nullptr : next->second.functions(next->second.instance, name);
}

}  // namespace

extern "C" VK_LAYER_EXPORT VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* answer) {
  return scene_analyzer::answer_loader(answer, get_instance_proc_addr, get_device_proc_addr);
}
