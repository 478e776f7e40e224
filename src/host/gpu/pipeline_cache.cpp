#include "gpu/pipeline_cache.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>
#include <system_error>

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

// The driver's data, or nothing when the file is absent or damaged.
Bytes read_sound(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  Bytes bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  std::uint64_t stored = 0;
  if (bytes.size() > sizeof stored) {
    std::memcpy(&stored, bytes.data() + bytes.size() - sizeof stored, sizeof stored);
    bytes.resize(bytes.size() - sizeof stored);
    if (checksum(bytes) == stored) return bytes;
  }
  spdlog::warn("the pipeline cache {} is damaged and will be made anew", file.string());
  return {};
}

[[noreturn]] void fail(const std::string& doing, const fs::path& file) {
  throw std::system_error(errno, std::generic_category(), doing + " the pipeline cache " + file.string());
}

// A file of its own beside the target: closed and removed unless renamed away.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : path_(target.string() + ".XXXXXX") {
    descriptor_ = ::mkostemp(path_.data(), O_CLOEXEC);
    if (descriptor_ < 0) fail("creating", path_);
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!renamed_) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::span<const std::uint8_t> data) {
    while (!data.empty()) {
      const ssize_t written = ::write(descriptor_, data.data(), data.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail("writing", path_);
      data = data.subspan(static_cast<std::size_t>(written));
    }
  }
  void move_to(const fs::path& target) {
    if (::fsync(descriptor_) != 0) fail("syncing", path_);
    const int closed = ::close(std::exchange(descriptor_, -1));
    if (closed != 0) fail("closing", path_);
    if (::rename(path_.c_str(), target.c_str()) != 0) fail("renaming", path_);
    renamed_ = true;
  }

 private:
  std::string path_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

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
  const Bytes data = cache_.getData();
  const std::uint64_t sum = checksum(data);
  if (loaded_ && sum == loaded_checksum_) return;
  fs::create_directories(file_.parent_path());
  TemporaryFile temporary(file_);
  temporary.write(data);
  temporary.write({reinterpret_cast<const std::uint8_t*>(&sum), sizeof sum});
  temporary.move_to(file_);
}

}  // namespace scene_analyzer::gpu
