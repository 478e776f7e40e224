#include "gpu/instance.h"

#include <algorithm>
#include <cstring>

#include "gpu/error.h"
#include "gpu/native.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kNoLoader =
    "no Vulkan loader (libvulkan.so.1) on this machine: install libvulkan1, and the GPU's driver or "
    "mesa-vulkan-drivers "
    "(which also brings a CPU device)";
constexpr const char* kNoDriver =
    "no Vulkan driver on this machine: install the GPU's driver, or mesa-vulkan-drivers (which also brings a "
    "CPU device)";

VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                       VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
  static_cast<ValidationLog*>(log)->add(data->pMessage);
  return VK_FALSE;
}

vk::raii::Context open_loader() {
  try {
    return {};
  } catch (const std::runtime_error&) {  // the loader library could not be opened
    throw NoDevice(kNoLoader);
  }
}

void require_validation_layer(const vk::raii::Context& context) {
  const auto layers = context.enumerateInstanceLayerProperties();
  const bool found = std::any_of(layers.begin(), layers.end(), [](const vk::LayerProperties& layer) {
    return std::strcmp(layer.layerName, kValidationLayer) == 0;
  });
  if (!found)
    throw Error(std::string("validation needs the layer ") + kValidationLayer +
                ": install vulkan-validationlayers");
}

vk::DebugUtilsMessengerCreateInfoEXT messenger_info(ValidationLog& log) {
  return {.messageSeverity = vk::DebugUtilsMessageSeverityFlagBitsEXT::eWarning |
                             vk::DebugUtilsMessageSeverityFlagBitsEXT::eError,
          // Not eGeneral: the loader reports there about other drivers on the machine.
          .messageType = vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation |
                         vk::DebugUtilsMessageTypeFlagBitsEXT::ePerformance,
          .pfnUserCallback = collect,
          .pUserData = &log};
}

}  // namespace

void ValidationLog::add(std::string message) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(std::move(message));
}

std::vector<std::string> ValidationLog::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

Instance make_instance(bool validation, const std::vector<std::string>& surface_extensions) {
  Instance made{.log = std::make_unique<ValidationLog>(), .context = open_loader()};
  const vk::ApplicationInfo application{.pApplicationName = "scene-analyzer",
                                        .apiVersion = VK_API_VERSION_1_3};
  vk::InstanceCreateInfo info{.pApplicationInfo = &application};

  const auto synchronization = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
  const vk::ValidationFeaturesEXT features{.enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = &synchronization};
  auto messenger = messenger_info(*made.log);
  messenger.pNext = &features;  // so that creation and destruction of the instance are watched too
  std::vector<const char*> extensions;
  for (const std::string& extension : surface_extensions) extensions.push_back(extension.c_str());
  if (validation) {
    translated("listing Vulkan layers", [&] { require_validation_layer(made.context); });
    info.pNext = &messenger;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kValidationLayer;
    extensions.insert(extensions.end(),
                      {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME});
  }
  info.setPEnabledExtensionNames(extensions);
  try {
    made.instance = vk::raii::Instance(made.context, info);
  } catch (const vk::IncompatibleDriverError&) {
    throw NoDevice(kNoDriver);
  } catch (const vk::SystemError&) {
    rethrow_as_gpu_error("creating the Vulkan instance");
  }
  if (validation)
    made.messenger = translated("creating the debug messenger", [&] {
      return vk::raii::DebugUtilsMessengerEXT(made.instance, messenger_info(*made.log));
    });
  return made;
}

}  // namespace scene_analyzer::gpu
