#include "gpu/vulkan_errors.h"

#include "gpu/error.h"

namespace scene_analyzer::gpu {

std::string device_lost_message(const std::string& doing) {
  return "the GPU was lost while " + doing +
         ": its driver reset it or it went away. Start again; when it happens again, look for GPU errors in "
         "the kernel log (dmesg), update the driver, or choose another device with --device.";
}

void rethrow_as_gpu_error(const std::string& doing) {
  try {
    throw;
  } catch (const vk::DeviceLostError&) {
    throw DeviceLost(device_lost_message(doing));
  } catch (const vk::OutOfDeviceMemoryError&) {
    throw OutOfMemory("out of GPU memory while " + doing);
  } catch (const vk::OutOfHostMemoryError&) {
    throw OutOfMemory("the GPU driver ran out of host memory while " + doing);
  } catch (const vk::TooManyObjectsError&) {
    throw OutOfMemory("the device allows no more allocations while " + doing);
  } catch (const vk::SystemError& error) {
    throw Error("Vulkan failed while " + doing + ": " + error.what());
  }
}

}  // namespace scene_analyzer::gpu
