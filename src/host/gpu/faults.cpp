#include "gpu/faults.h"

#include "gpu/native.h"

namespace scene_analyzer::gpu {

Faults& faults(Device& device) {
  return device.native().faults;
}

}  // namespace scene_analyzer::gpu
