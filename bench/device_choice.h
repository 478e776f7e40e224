// device_choice.h — The device that benchmarks run on: the default one, or SCENE_ANALYZER_DEVICE.
#pragma once

#include <cstdlib>

#include "gpu/device.h"

namespace scene_analyzer::bench {

inline gpu::DeviceOptions device_options() {
  gpu::DeviceOptions options;
  if (const char* selector = std::getenv("SCENE_ANALYZER_DEVICE")) options.selector = selector;
  return options;
}

}  // namespace scene_analyzer::bench
