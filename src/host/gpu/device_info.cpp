#include "gpu/device_info.h"

#include <algorithm>
#include <cstring>
#include <thread>

#include "gpu/host_memory.h"
#include "gpu/native.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::gpu {
namespace {

DeviceType type_of(vk::PhysicalDeviceType type) {
  switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return DeviceType::kDiscrete;
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return DeviceType::kIntegrated;
    case vk::PhysicalDeviceType::eVirtualGpu:
      return DeviceType::kVirtual;
    case vk::PhysicalDeviceType::eCpu:
      return DeviceType::kCpu;
    case vk::PhysicalDeviceType::eOther:
      break;
  }
  return DeviceType::kOther;
}

bool has_extension(const vk::raii::PhysicalDevice& device, const char* name) {
  const auto extensions = device.enumerateDeviceExtensionProperties();
  return std::any_of(extensions.begin(), extensions.end(), [&](const vk::ExtensionProperties& extension) {
    return std::strcmp(extension.extensionName, name) == 0;
  });
}

std::string version_text(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) +
         "." + std::to_string(VK_API_VERSION_PATCH(version));
}

std::vector<std::string> refusals_of(const vk::raii::PhysicalDevice& device, std::uint32_t api_version) {
  if (api_version < VK_API_VERSION_1_3)  // the questions below cannot even be asked
    return {"Vulkan 1.3 is needed, the driver offers " + version_text(api_version)};
  std::vector<std::string> reasons;
  const auto need = [&](bool present, const char* reason) {
    if (!present) reasons.emplace_back(reason);
  };
  const auto features = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                                            vk::PhysicalDeviceVulkan13Features>();
  const auto& core = features.get<vk::PhysicalDeviceFeatures2>().features;
  const auto& core13 = features.get<vk::PhysicalDeviceVulkan13Features>();
  need(core.shaderFloat64, "no double precision in shaders (shaderFloat64)");
  need(core.shaderInt64, "no 64-bit integers in shaders (shaderInt64)");
  need(features.get<vk::PhysicalDeviceVulkan12Features>().scalarBlockLayout,
       "no scalar block layout (scalarBlockLayout)");
  need(core13.synchronization2, "no synchronization2");
  need(core13.maintenance4, "no maintenance4");
  need(has_extension(device, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME),
       "no push descriptors (VK_KHR_push_descriptor)");
  need(choose_queue_family(device).has_value(), "no compute queue");
  return reasons;
}

// The type every storage buffer of this device is put in; the device itself refines this by memoryTypeBits.
std::uint32_t usual_memory_type(const vk::raii::PhysicalDevice& device, DeviceType type) {
  return MemoryTypes(device.getMemoryProperties(), type).for_buffers(~0u).value_or(0);
}

std::string id_of(const vk::raii::PhysicalDevice& device, DeviceType type) {
  const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceIDProperties>();
  std::string id;
  for (const std::uint8_t byte : chain.get<vk::PhysicalDeviceIDProperties>().deviceUUID) {
    constexpr const char* kDigits = "0123456789abcdef";
    id += {kDigits[byte >> 4], kDigits[byte & 15]};
  }
  if (type == DeviceType::kCpu)
    id += ", " + processor_name() + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads";
  return id;
}

void describe_drawing(const vk::raii::PhysicalDevice& device, const vk::PhysicalDeviceProperties& properties,
                      DeviceInfo& info) {
  const auto queue = choose_queue_family(device);
  if (!queue) return;
  const vk::QueueFamilyProperties family = device.getQueueFamilyProperties()[*queue];
  const auto draws_to = [&](vk::Format format, vk::FormatFeatureFlags usage) {
    return (device.getFormatProperties(format).optimalTilingFeatures & usage) == usage;
  };
  info.can_draw = (family.queueFlags & vk::QueueFlagBits::eGraphics) &&
                  draws_to(kColorFormat, vk::FormatFeatureFlagBits::eColorAttachment) &&
                  draws_to(kDepthFormat, vk::FormatFeatureFlagBits::eDepthStencilAttachment);
  info.max_index = properties.limits.maxDrawIndexedIndexValue;
  info.timestamp_bits = family.timestampValidBits;
  info.timestamp_period_ns = properties.limits.timestampPeriod;
  const vk::PhysicalDeviceFeatures features = device.getFeatures();
  info.counts_invocations = features.pipelineStatisticsQuery != 0;
  info.numbers_triangles = features.geometryShader != 0;
  info.draws_wireframes = features.fillModeNonSolid != 0;
}

}  // namespace

std::vector<vk::raii::PhysicalDevice> physical_devices(const Instance& instance) {
  return translated("listing the devices", [&] {
    vk::raii::PhysicalDevices devices(instance.instance);
    return std::vector<vk::raii::PhysicalDevice>(std::make_move_iterator(devices.begin()),
                                                 std::make_move_iterator(devices.end()));
  });
}

std::optional<std::uint32_t> choose_queue_family(const vk::raii::PhysicalDevice& device) {
  const auto families = device.getQueueFamilyProperties();
  std::optional<std::uint32_t> compute;
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if (!(families[i].queueFlags & vk::QueueFlagBits::eCompute)) continue;
    if (families[i].queueFlags & vk::QueueFlagBits::eGraphics) return i;
    if (!compute) compute = i;
  }
  return compute;
}

bool can_present(const vk::raii::PhysicalDevice& device) {
  return has_extension(device, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
}

std::uint64_t free_memory_bytes(const vk::raii::PhysicalDevice& device, DeviceType type) {
  const vk::PhysicalDeviceMemoryProperties memory = device.getMemoryProperties();
  const std::uint32_t heap = memory.memoryTypes[usual_memory_type(device, type)].heapIndex;
  std::uint64_t free = memory.memoryHeaps[heap].size;
  if (has_extension(device, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME)) {
    const auto chain = device.getMemoryProperties2<vk::PhysicalDeviceMemoryProperties2,
                                                   vk::PhysicalDeviceMemoryBudgetPropertiesEXT>();
    const auto& budget = chain.get<vk::PhysicalDeviceMemoryBudgetPropertiesEXT>();
    free = budget.heapBudget[heap] - std::min(budget.heapBudget[heap], budget.heapUsage[heap]);
  }
  if (type == DeviceType::kCpu) free = std::min(free, free_host_memory_bytes().value_or(free));
  return free;
}

DeviceInfo describe_device(const vk::raii::PhysicalDevice& device, std::uint32_t index) {
  return translated("describing a device", [&] {
    const vk::PhysicalDeviceProperties properties = device.getProperties();
    DeviceInfo info;
    info.index = index;
    info.name = properties.deviceName.data();
    info.driver = "driver " + std::to_string(properties.driverVersion);
    info.api_version = version_text(properties.apiVersion);
    info.type = type_of(properties.deviceType);
    info.max_storage_buffer_bytes = properties.limits.maxStorageBufferRange;
    info.refusals = refusals_of(device, properties.apiVersion);
    if (properties.apiVersion < VK_API_VERSION_1_3) return info;
    describe_drawing(device, properties, info);

    const auto chain =
        device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties,
                              vk::PhysicalDeviceSubgroupProperties, vk::PhysicalDeviceVulkan13Properties,
                              vk::PhysicalDeviceMaintenance3Properties>();
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    info.driver = std::string(driver.driverName.data()) + " " + driver.driverInfo.data();
    info.id = id_of(device, info.type);
    info.subgroup_size = chain.get<vk::PhysicalDeviceSubgroupProperties>().subgroupSize;
    info.max_allocation_bytes = chain.get<vk::PhysicalDeviceMaintenance3Properties>().maxMemoryAllocationSize;
    const MemoryTypes memory(device.getMemoryProperties(), info.type);
    info.memory_bytes = memory.heap_bytes(usual_memory_type(device, info.type));
    info.free_memory_bytes = free_memory_bytes(device, info.type);
    return info;
  });
}

std::vector<DeviceInfo> list_devices() {
  const Instance instance = make_instance(false);
  std::vector<DeviceInfo> infos;
  for (const auto& device : physical_devices(instance))
    infos.push_back(describe_device(device, static_cast<std::uint32_t>(infos.size())));
  return infos;
}

}  // namespace scene_analyzer::gpu
