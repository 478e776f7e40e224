#include "gpu/device_selection.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "gpu/error.h"

namespace scene_analyzer::gpu {
namespace {

constexpr const char* kInstallHint =
    "install the GPU's driver with Vulkan 1.3, or mesa-vulkan-drivers (which also brings a CPU device)";

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool is_number(const std::string& text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

std::string describe(const DeviceInfo& device) {
  std::string line = "  " + std::to_string(device.index) + ": " + device.name + " (" +
                     to_string(device.type) + ", " + device.driver + ", Vulkan " + device.api_version + "): ";
  if (device.refusals.empty()) return line + "usable\n";
  for (std::size_t i = 0; i < device.refusals.size(); ++i) line += (i == 0 ? "" : "; ") + device.refusals[i];
  return line + "\n";
}

std::string describe_all(const std::vector<DeviceInfo>& devices) {
  std::string text;
  for (const DeviceInfo& device : devices) text += describe(device);
  return text;
}

std::vector<std::size_t> candidates(const std::vector<DeviceInfo>& devices, const std::string& selector) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < devices.size(); ++i)
    if (is_number(selector) ? std::to_string(devices[i].index) == selector
                            : lower(devices[i].name).find(lower(selector)) != std::string::npos)
      found.push_back(i);
  return found;
}

}  // namespace

const char* to_string(DeviceType type) {
  switch (type) {
    case DeviceType::kDiscrete:
      return "discrete";
    case DeviceType::kIntegrated:
      return "integrated";
    case DeviceType::kVirtual:
      return "virtual";
    case DeviceType::kCpu:
      return "cpu";
    case DeviceType::kOther:
      break;
  }
  return "other";
}

std::size_t select_device(const std::vector<DeviceInfo>& devices, const std::string& selector) {
  if (devices.empty())
    throw NoDevice(std::string("the Vulkan drivers of this machine offer no device: ") + kInstallHint);
  const std::vector<std::size_t> asked = candidates(devices, selector);
  if (asked.empty())
    throw NoDevice("no device is number or has the name '" + selector + "'. The devices are:\n" +
                   describe_all(devices) + "choose one of them by its number or a part of its name");

  std::optional<std::size_t> best;
  for (const std::size_t i : asked) {
    if (!devices[i].refusals.empty()) continue;
    if (!best || devices[i].type < devices[*best].type) best = i;  // the enum is in order of preference
  }
  if (best) return *best;
  if (selector.empty())
    throw NoDevice("no device of this machine can be used. The devices are:\n" + describe_all(devices) +
                   kInstallHint);
  throw NoDevice("device '" + selector + "' cannot be used. The devices are:\n" + describe_all(devices) +
                 "choose another one, or " + kInstallHint);
}

}  // namespace scene_analyzer::gpu
