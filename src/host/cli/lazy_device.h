// lazy_device.h — The GPU device of one run: made when first needed, or ahead of time on another thread.
//
// A run whose results are all on file never starts Vulkan; any other run starts it while the import worker
// reads the first asset, which hides its 100 ms and more.
#pragma once

#include <future>
#include <memory>
#include <optional>

#include "gpu/device.h"

namespace scene_analyzer::cli {

// The device options of every command: the pipeline cache below $XDG_CACHE_HOME or ~/.cache (nowhere when
// that cannot be written), the validation layer with SCENE_ANALYZER_VALIDATION=1. Throws UsageError for
// another value of that variable.
gpu::DeviceOptions device_options(const std::string& selector);

// To be called before a driver is opened, as device_options() does. Mesa maps a file of its shader cache,
// which lies beside ours, into memory: on a full disk the first look at it would end the process (SIGBUS).
void keep_drivers_off_a_full_disk();

class LazyDevice {
 public:
  explicit LazyDevice(gpu::DeviceOptions options) : options_(std::move(options)) {}

  // Begins to create the device; its errors come out of get(), or nowhere if nobody asks.
  void start();
  gpu::Device& get();  // throws gpu::NoDevice
  // Of a device that was lost: the next get() makes a new one. What was made of the former must be gone.
  void forget();
  // Messages of the validation layer; empty when there is no device or no layer.
  std::vector<std::string> take_validation_messages();

 private:
  gpu::DeviceOptions options_;
  std::future<std::unique_ptr<gpu::Device>> pending_;
  std::unique_ptr<gpu::Device> device_;
  std::vector<std::string> former_messages_;  // of devices that were forgotten
};

}  // namespace scene_analyzer::cli
