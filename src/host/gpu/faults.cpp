#include "gpu/faults.h"

#include "gpu/native.h"

namespace scene_analyzer::gpu {

Faults& faults(Device& device) {
  return device.native().faults;
}

bool allocation_fails(Faults& faults) {
  if (!faults.allocations_until_failure) return false;
  if (*faults.allocations_until_failure == 0) {
    faults.allocations_until_failure.reset();
    return true;
  }
  --*faults.allocations_until_failure;
  return false;
}

}  // namespace scene_analyzer::gpu
