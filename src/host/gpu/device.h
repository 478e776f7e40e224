// device.h — One Vulkan device: chosen, created, and the maker of everything on it. Vulkan-free face.
//
// Required: Vulkan 1.3 (synchronization2, maintenance4), shaderFloat64, shaderInt64, scalarBlockLayout,
// VK_KHR_push_descriptor, a compute queue. Preferred order: discrete, integrated, virtual, CPU; within a type
// the order of the driver.
//
// Thread rule: a Device and what it made belong to one thread at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/kernel.h"
#include "gpu/raster_pipeline.h"
#include "gpu/render_target.h"
#include "gpu/texture.h"

namespace scene_analyzer::gpu {

enum class DeviceType { kDiscrete, kIntegrated, kVirtual, kCpu, kOther };
const char* to_string(DeviceType type);  // "discrete", "integrated", "virtual", "cpu", "other"

struct DeviceInfo {
  std::uint32_t index = 0;  // position in the driver's list, what --device INDEX means
  std::string name;         // "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string driver;       // name and version of the driver
  std::string api_version;  // "1.3.230"
  // The driver's UUID of the device in hexadecimal digits; of a CPU device, where that is the driver's alone,
  // the processor and its number of threads as well: "6d65...00, AMD EPYC, 2 threads".
  std::string id;
  DeviceType type = DeviceType::kOther;
  std::uint64_t max_storage_buffer_bytes = 0;  // maxStorageBufferRange
  std::uint64_t max_allocation_bytes = 0;      // maxMemoryAllocationSize
  std::uint64_t memory_bytes = 0;              // size of the heap that buffers come from
  std::uint64_t free_memory_bytes = 0;  // VK_EXT_memory_budget (budget - usage) or the operating system's
                                        // free memory on CPU devices; else the heap's size
  std::uint32_t subgroup_size = 0;
  std::uint32_t max_index = 0;  // of a vertex in a draw (maxDrawIndexedIndexValue)
  bool can_draw = false;        // its queue takes graphics commands, and it has the formats of RenderTarget
  std::uint32_t timestamp_bits = 0;   // of its queue's counter (timestampValidBits); 0: it has none
  double timestamp_period_ns = 0;     // of one tick
  bool counts_invocations = false;    // of shaders, per draw (pipelineStatisticsQuery)
  bool numbers_triangles = false;     // fragment shaders know the triangle's number (geometryShader)
  bool draws_wireframes = false;      // fillModeNonSolid
  std::vector<std::string> refusals;  // why it cannot be used, one reason each; empty: usable
};

// Every Vulkan device of this machine, usable or not. Throws NoDevice when there is no Vulkan loader or
// driver at all.
std::vector<DeviceInfo> list_devices();

struct DeviceOptions {
  std::string selector;     // "", an index, or a part of the name (case-insensitive)
  bool validation = false;  // validation layer with synchronisation validation; throws when missing
  // For a window: what its system wants of Vulkan, and that the device can show pictures there. Empty: no
  // window.
  std::vector<std::string> surface_extensions = {};
  // Where the pipeline cache file is kept; absent: nowhere.
  std::optional<std::filesystem::path> cache_folder;
};

class Device {
 public:
  explicit Device(const DeviceOptions& options = {});  // throws NoDevice
  ~Device();                                           // writes the pipeline cache (atomically) when it grew
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceInfo& info() const;

  // `bytes` are rounded up to 16; never zero. Contents are undefined. Throws OutOfMemory naming `name`, need
  // and limit (the smaller of maxStorageBufferRange, maxMemoryAllocationSize and what the driver gives).
  Buffer make_buffer(const std::string& name, std::uint64_t bytes);

  // `words` is SPIR-V; specialisation constants 0, 1, ... get the given values.
  // Bindings, push constant size and local size are read from the SPIR-V.
  Kernel make_kernel(const std::string& name, std::span<const std::uint32_t> words,
                     std::span<const std::uint32_t> specialization = {});

  // Throws Error when the device cannot draw, or not so large a picture; OutOfMemory. Every device that draws
  // takes 1 and 4 samples per pixel.
  RenderTarget make_render_target(const std::string& name, std::uint32_t width, std::uint32_t height,
                                  std::uint32_t samples = 1);
  RasterPipeline make_raster_pipeline(const std::string& name, const RasterShaders& shaders);

  // `rgba`: 4 bytes per pixel, rows from the top. Throws Error when the device cannot draw, or not so large a
  // texture; OutOfMemory. Cost: linear in pixels; memory on the device 16/3 bytes per pixel.
  Texture make_texture(const std::string& name, std::uint32_t width, std::uint32_t height,
                       std::span<const std::uint8_t> rgba);

  // Vertices or indices for draws; the same rules as for make_buffer(), but for maxStorageBufferRange.
  Buffer make_vertex_buffer(const std::string& name, std::uint64_t bytes);

  // Synchronous copies; host-visible device memory is written directly, other memory through a bounded
  // staging buffer.
  void upload(const Buffer& buffer, std::uint64_t offset_bytes, std::span<const std::byte> data);
  void download(const Buffer& buffer, std::uint64_t offset_bytes, std::span<std::byte> data);

  std::uint64_t buffer_bytes() const;       // held by live buffers now
  std::uint64_t peak_buffer_bytes() const;  // largest value since reset_peak()
  void reset_peak();

  // Warnings and errors of the validation layer so far; the list of a silent run is empty. Cleared by the
  // call.
  std::vector<std::string> take_validation_messages();

  struct Native;  // gpu/native.h: the one marked door for FFT, raster and window
  Native& native() const { return *native_; }

 private:
  std::unique_ptr<Native> native_;
};

}  // namespace scene_analyzer::gpu

#include "gpu/array_inl.h"
