#include "gpu/pipeline_cache.h"

#include <spdlog/spdlog.h>
#include <xxhash.h>

#include <cstring>
#include <span>
#include <system_error>
#include <utility>

#include "files/file.h"
#include "files/replace.h"

namespace scene_analyzer::gpu {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

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

std::uint64_t checksum(std::span<const std::uint8_t> data) {
  return XXH3_64bits(data.data(), data.size());
}

// Nothing for what is absent or cannot be read: what is wrong with it shows when it is written anew.
std::optional<Bytes> read_whole(const fs::path& path) {
  try {
    files::File file = files::File::open_regular(path);
    Bytes bytes(static_cast<std::size_t>(file.size()));
    bytes.resize(file.read({reinterpret_cast<char*>(bytes.data()), bytes.size()}));
    return bytes;
  } catch (const std::system_error&) {
    return std::nullopt;
  }
}

// The driver's data, or nothing when the file is absent or damaged.
Bytes read_sound(const fs::path& file) {
  auto contents = read_whole(file);
  if (!contents) return {};
  Bytes& bytes = *contents;
  std::uint64_t stored = 0;
  if (bytes.size() > sizeof stored) {
    std::memcpy(&stored, bytes.data() + bytes.size() - sizeof stored, sizeof stored);
    bytes.resize(bytes.size() - sizeof stored);
    if (checksum(bytes) == stored) return std::move(bytes);
  }
  spdlog::warn("the pipeline cache {} is damaged and will be made anew", file.string());
  return {};
}

}  // namespace

PipelineCache::PipelineCache(const vk::raii::Device& device, const vk::PhysicalDeviceProperties& properties,
                             const std::optional<fs::path>& folder) {
  Bytes data;
  if (folder) {
    file_ = *folder / file_name(properties);
    data = read_sound(file_);
    loaded_ = !data.empty();
    loaded_checksum_ = checksum(data);
  }
  cache_ = vk::raii::PipelineCache(device, {.initialDataSize = data.size(), .pInitialData = data.data()});
}

void PipelineCache::save() {
  if (file_.empty() || *cache_ == vk::PipelineCache{}) return;
  Bytes data = cache_.getData();
  const std::uint64_t sum = checksum(data);
  if (loaded_ && sum == loaded_checksum_) return;
  fs::create_directories(file_.parent_path());
  const auto* sum_bytes = reinterpret_cast<const std::uint8_t*>(&sum);
  data.insert(data.end(), sum_bytes, sum_bytes + sizeof sum);
  const auto* bytes = reinterpret_cast<const char*>(data.data());
  try {
    files::replace(file_, {bytes, data.size()}, {.mode = 0600});
  } catch (const std::system_error& error) {
    throw std::system_error(error.code(), "writing the pipeline cache " + file_.string());
  }
}

}  // namespace scene_analyzer::gpu
