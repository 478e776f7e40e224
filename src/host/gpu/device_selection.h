// device_selection.h — Which device is taken, and the message when none can be. Pure: no Vulkan.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gpu/device.h"

namespace scene_analyzer::gpu {

// Position in `devices` of the one to use. `selector` is "", an index, or a part of a name
// (case-insensitive); digits alone are always an index, so that a mistyped one does not find "llvmpipe
// (LLVM 15.0.6, 256 bits)". Among several: discrete, integrated, virtual, CPU, other; then the driver's
// order. Throws NoDevice, listing every device and why it was refused, with what to do.
std::size_t select_device(const std::vector<DeviceInfo>& devices, const std::string& selector);

}  // namespace scene_analyzer::gpu
