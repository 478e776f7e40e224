// small_device.h — The limit that small_device_layer.cpp gives to every device, for the tests that expect it.
#pragma once

#include <cstdint>

namespace scene_analyzer {

inline constexpr const char* kSmallDeviceLayer =
    "VK_LAYER_SCENE_ANALYZER_small_device";                        // as in the manifest
inline constexpr std::uint32_t kSmallDeviceBufferBytes = 1 << 16;  // maxStorageBufferRange

}  // namespace scene_analyzer
