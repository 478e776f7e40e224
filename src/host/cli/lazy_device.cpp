#include "cli/lazy_device.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "base/error.h"

namespace scene_analyzer::cli {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> pipeline_cache_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  fs::path folder;
  if (cache != nullptr && fs::path(cache).is_absolute())  // the XDG rules: a relative one is to be ignored
    folder = cache;
  else if (home != nullptr && fs::path(home).is_absolute())
    folder = fs::path(home) / ".cache";
  else
    return std::nullopt;
  folder /= "scene-analyzer";
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

gpu::DeviceOptions device_options(const std::string& selector) {
  gpu::DeviceOptions options;
  options.selector = selector;
  options.validation = validation_requested();
  options.cache_folder = pipeline_cache_folder();
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

std::vector<std::string> LazyDevice::take_validation_messages() {
  return device_ ? device_->take_validation_messages() : std::vector<std::string>();
}

}  // namespace scene_analyzer::cli
