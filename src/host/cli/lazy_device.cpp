#include "cli/lazy_device.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>
#include <utility>

#include "base/error.h"

namespace scene_analyzer::cli {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> cache_home() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  if (cache != nullptr && fs::path(cache).is_absolute())  // the XDG rules: a relative one is to be ignored
    return cache;
  if (home != nullptr && fs::path(home).is_absolute()) return fs::path(home) / ".cache";
  return std::nullopt;
}

std::optional<fs::path> pipeline_cache_folder() {
  const std::optional<fs::path> home = cache_home();
  if (!home) return std::nullopt;
  const fs::path folder = *home / "scene-analyzer";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || access(folder.c_str(), W_OK | X_OK) != 0) return std::nullopt;  // only costs time
  return folder;
}

bool validation_requested() {
  const char* variable = std::getenv("SCENE_ANALYZER_VALIDATION");
  const std::string_view value = variable == nullptr ? "" : variable;
  if (value.empty() || value == "0") return false;
  if (value == "1") return true;
  throw UsageError(fmt::format("SCENE_ANALYZER_VALIDATION: '{}' is neither 0 nor 1", value));
}

}  // namespace

void keep_drivers_off_a_full_disk() {
  constexpr std::uintmax_t kEnough = std::uintmax_t{16} << 20;
  const std::optional<fs::path> folder = cache_home();
  if (!folder) return;
  std::error_code error;
  const fs::space_info space = fs::space(*folder, error);
  if (!error && space.available < kEnough) setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
}

gpu::DeviceOptions device_options(const std::string& selector) {
  gpu::DeviceOptions options;
  options.selector = selector;
  options.validation = validation_requested();
  options.cache_folder = pipeline_cache_folder();
  keep_drivers_off_a_full_disk();
  return options;
}

void LazyDevice::start() {
  if (device_ || pending_.valid()) return;
  pending_ =
      std::async(std::launch::async, [options = options_] { return std::make_unique<gpu::Device>(options); });
}

gpu::Device& LazyDevice::get() {
  if (!device_) {
    start();
    device_ = pending_.get();
  }
  return *device_;
}

void LazyDevice::forget() {
  former_messages_ = take_validation_messages();
  device_.reset();
}

std::vector<std::string> LazyDevice::take_validation_messages() {
  std::vector<std::string> messages = std::exchange(former_messages_, {});
  if (!device_) return messages;
  for (std::string& message : device_->take_validation_messages()) messages.push_back(std::move(message));
  return messages;
}

}  // namespace scene_analyzer::cli
