// The one file that includes VkFFT.
#include <glslang/build_info.h>

#include <cstring>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

#include "gpu/cache_file.h"
#include "spectrum/fft_plan.h"
#include "spectrum/vkfft_calls.h"
// Below, because vkfft_calls.h stands in for what it calls. Both made by CMake (cmake/VkFFT.cmake).
#define VKFFT_BACKEND 0
#include <vkFFT.h>
#include <vkfft_error_names.h>

namespace scene_analyzer::spectrum {
namespace {

constexpr std::uint64_t kComplexBytes = 2 * sizeof(double);
constexpr std::uint32_t kLongestRow = 1U << 11;
constexpr std::uint32_t kSpirvMagic = 0x07230203;
const char* const kCacheFile = "plan of Fourier transforms";

using Bytes = std::vector<std::uint8_t>;

std::string error_name(VkFFTResult result) {
  for (const auto& [code, name] : kVkfftErrorNames)
    if (code == result) return name;
  return "error " + std::to_string(result);
}

[[noreturn]] void fail(const VkfftHost& host, VkFFTResult result, const std::string& doing) {
  if (host.failure) std::rethrow_exception(host.failure);
  const std::string what = "VkFFT failed while " + doing + ": " + error_name(result);
  if (result == VKFFT_ERROR_MALLOC_FAILED) throw gpu::OutOfMemory(what);
  throw gpu::Error(what);
}

// One file per length; its name holds a hash of all that the generated code depends on.
std::filesystem::path cache_file(const gpu::Device::Native& native, std::uint32_t length,
                                 std::uint32_t capacity) {
  const vk::PhysicalDeviceLimits& limits = native.limits;
  const std::initializer_list<std::uint64_t> parts{static_cast<std::uint64_t>(VkFFTGetVersion()),
                                                   GLSLANG_VERSION_MAJOR,
                                                   GLSLANG_VERSION_MINOR,
                                                   GLSLANG_VERSION_PATCH,
                                                   native.physical_device.getProperties().vendorID,
                                                   length,
                                                   capacity,
                                                   limits.maxComputeSharedMemorySize,
                                                   limits.maxComputeWorkGroupInvocations,
                                                   limits.maxComputeWorkGroupCount[0],
                                                   limits.maxComputeWorkGroupCount[1],
                                                   limits.maxComputeWorkGroupCount[2],
                                                   limits.maxComputeWorkGroupSize[0],
                                                   limits.maxComputeWorkGroupSize[1],
                                                   limits.maxComputeWorkGroupSize[2]};
  const std::uint64_t hash =
      gpu::cache_checksum({reinterpret_cast<const std::uint8_t*>(parts.begin()), parts.size() * 8});
  char name[64];
  std::snprintf(name, sizeof name, "fft-%u-%016llx.bin", length, static_cast<unsigned long long>(hash));
  return *native.cache_folder / name;
}

// What VkFFT saves for a plan of one kernel: the size of its SPIR-V in bytes, and the SPIR-V. Anything else
// is not handed to it, since it believes that size.
bool is_one_kernel(const Bytes& saved) {
  std::uint32_t words[2];
  if (saved.size() <= sizeof words || saved.size() % 4 != 0) return false;
  std::memcpy(words, saved.data(), sizeof words);
  return words[0] == saved.size() - 4 && words[1] == kSpirvMagic;
}

}  // namespace

struct FftPlan::Impl {
  VkfftHost host;
  std::uint32_t length;
  std::uint32_t capacity;
  // VkFFT keeps the addresses of these.
  VkfftDevice device;
  VkPhysicalDevice physical_device;
  VkQueue queue;
  VkCommandPool command_pool;
  VkFence fence;
  std::uint64_t buffer_bytes;
  VkBuffer buffer = VK_NULL_HANDLE;
  VkFFTApplication application{};

  Impl(gpu::Device::Native& native, std::uint32_t row_length, std::uint32_t rows)
      : host(native),
        length(row_length),
        capacity(rows),
        device{*native.device, &host},
        physical_device(*native.physical_device),
        queue(*native.queue),
        command_pool(*native.command_pool),
        fence(*native.fence),
        buffer_bytes(kComplexBytes * rows * row_length) {
    try {
      initialize_from_cache();
    } catch (...) {
      deleteVkFFT(&application);
      throw;
    }
  }
  ~Impl() { deleteVkFFT(&application); }

  VkFFTAxis& axis() { return application.localFFTPlan->axes[0][0]; }
  std::string name() const { return "Fourier transform of " + std::to_string(length); }

 private:
  void initialize_from_cache();
  void initialize(const Bytes& saved);
  void store(const std::filesystem::path& file) const;
};

void FftPlan::Impl::initialize_from_cache() {
  if (!host.native.cache_folder) return initialize({});
  const std::filesystem::path file = cache_file(host.native, length, capacity);
  const Bytes saved = gpu::read_cache_file(file, kCacheFile);
  const bool usable = is_one_kernel(saved);
  initialize(usable ? saved : Bytes());
  if (!usable) store(file);
}

// `saved`: what an earlier plan left, or nothing.
void FftPlan::Impl::initialize(const Bytes& saved) {
  VkFFTConfiguration configuration{};
  configuration.FFTdim = 1;
  configuration.size[0] = length;
  configuration.size[1] = configuration.size[2] = 1;
  configuration.numberBatches = capacity;
  configuration.doublePrecision = 1;
  configuration.makeForwardPlanOnly = 1;
  configuration.physicalDevice = &physical_device;
  configuration.device = &device.handle;
  configuration.queue = &queue;
  configuration.commandPool = &command_pool;
  configuration.fence = &fence;
  configuration.bufferSize = &buffer_bytes;
  configuration.saveApplicationToString = saved.empty() ? 1 : 0;
  configuration.loadApplicationFromString = saved.empty() ? 0 : 1;
  configuration.loadApplicationString = const_cast<std::uint8_t*>(saved.data());
  const ClassicLocale numbers_with_points;
  const VkFFTResult result = initializeVkFFT(&application, configuration);
  if (result != VKFFT_SUCCESS) fail(host, result, "planning a " + name());
  if (application.localFFTPlan->numAxisUploads[0] != 1)
    throw gpu::Error("VkFFT does a " + name() + " in more than one step");
  application.configuration.buffer = &buffer;
  host.native.set_name(vk::ObjectType::ePipeline, reinterpret_cast<std::uint64_t>(axis().pipeline), name());
}

void FftPlan::Impl::store(const std::filesystem::path& file) const {
  const auto* bytes = static_cast<const std::uint8_t*>(application.saveApplicationString);
  try {
    gpu::write_cache_file(file, kCacheFile, {bytes, application.applicationStringSize});
  } catch (const std::exception& error) {  // only the next start is slower
    spdlog::warn("{}", error.what());
  }
}

std::uint32_t longest_fft_row(const gpu::Device& device) {
  const std::uint64_t shared_memory = device.native().limits.maxComputeSharedMemorySize;
  std::uint32_t length = kLongestRow;
  while (length * kComplexBytes > shared_memory) length /= 2;
  return length;
}

FftPlan::FftPlan(gpu::Device& device, std::uint32_t length, std::uint32_t capacity)
    : impl_(std::make_unique<Impl>(device.native(), length, capacity)) {}
FftPlan::~FftPlan() = default;

std::uint32_t FftPlan::rows_per_group() const {
  return static_cast<std::uint32_t>(impl_->axis().axisBlock[1]);
}

void FftPlan::bind(const gpu::Buffer& buffer) {
  impl_->buffer = *buffer.impl().buffer;
  impl_->axis().specializationConstants.performBufferSetUpdate = 1;
}

void FftPlan::record(gpu::Recorder& recorder, std::uint32_t rows) {
  Impl& plan = *impl_;
  if (rows == 0 || rows > plan.capacity)
    throw std::logic_error("a " + plan.name() + " for " + std::to_string(plan.capacity) + " rows, not " +
                           std::to_string(rows));
  const vk::raii::CommandBuffer& commands = recorder.impl().next_step();
  auto& stopwatch = recorder.impl().stopwatch;
  if (stopwatch) stopwatch->start(commands, plan.name());
  // Workgroups are counted from here, so the plan's other rows cost nothing.
  plan.application.localFFTPlan->actualFFTSizePerAxis[0][1] = rows;
  VkCommandBuffer handle = *commands;
  VkFFTLaunchParams launch{};
  launch.commandBuffer = &handle;
  const VkFFTResult result = VkFFTAppend(&plan.application, -1, &launch);
  if (result != VKFFT_SUCCESS) fail(plan.host, result, "recording a " + plan.name());
  if (stopwatch) stopwatch->stop(commands);
}

}  // namespace scene_analyzer::spectrum
