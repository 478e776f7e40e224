#include "gpu/pipeline_cache.h"

#include <vector>

#include "gpu/cache_file.h"

namespace scene_analyzer::gpu {
namespace {

const char* const kWhat = "pipeline cache";

std::string file_name(const vk::PhysicalDeviceProperties& properties) {
  char text[32];
  std::snprintf(text, sizeof text, "pipelines-%08x-%08x-", properties.vendorID, properties.deviceID);
  std::string name = text;
  for (const std::uint8_t byte : properties.pipelineCacheUUID) {
    std::snprintf(text, sizeof text, "%02x", byte);
    name += text;
  }
  return name + ".bin";
}

}  // namespace

PipelineCache::PipelineCache(const vk::raii::Device& device, const vk::PhysicalDeviceProperties& properties,
                             const std::optional<std::filesystem::path>& folder) {
  std::vector<std::uint8_t> data;
  if (folder) {
    file_ = *folder / file_name(properties);
    data = read_cache_file(file_, kWhat);
    loaded_ = !data.empty();
    loaded_checksum_ = cache_checksum(data);
  }
  cache_ = vk::raii::PipelineCache(device, {.initialDataSize = data.size(), .pInitialData = data.data()});
}

void PipelineCache::save() {
  if (file_.empty() || *cache_ == vk::PipelineCache{}) return;
  const std::vector<std::uint8_t> data = cache_.getData();
  if (loaded_ && cache_checksum(data) == loaded_checksum_) return;
  write_cache_file(file_, kWhat, data);
}

}  // namespace scene_analyzer::gpu
