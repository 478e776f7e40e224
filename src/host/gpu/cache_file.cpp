#include "gpu/cache_file.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

namespace scene_analyzer::gpu {
namespace {

namespace fs = std::filesystem;

// A file of its own beside the target: closed and removed unless renamed away.
class TemporaryFile {
 public:
  TemporaryFile(const fs::path& target, std::string what)
      : what_(std::move(what)), path_(target.string() + ".XXXXXX") {
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
  [[noreturn]] void fail(const std::string& doing, const fs::path& file) const {
    throw std::system_error(errno, std::generic_category(), doing + " the " + what_ + " " + file.string());
  }

  std::string what_;
  std::string path_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

}  // namespace

std::uint64_t cache_checksum(std::span<const std::uint8_t> data) {
  return XXH3_64bits(data.data(), data.size());
}

std::vector<std::uint8_t> read_cache_file(const fs::path& file, const std::string& what) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  std::uint64_t stored = 0;
  if (bytes.size() > sizeof stored) {
    std::memcpy(&stored, bytes.data() + bytes.size() - sizeof stored, sizeof stored);
    bytes.resize(bytes.size() - sizeof stored);
    if (cache_checksum(bytes) == stored) return bytes;
  }
  spdlog::warn("the {} {} is damaged and will be made anew", what, file.string());
  return {};
}

void write_cache_file(const fs::path& file, const std::string& what, std::span<const std::uint8_t> data) {
  const std::uint64_t sum = cache_checksum(data);
  fs::create_directories(file.parent_path());
  TemporaryFile temporary(file, what);
  temporary.write(data);
  temporary.write({reinterpret_cast<const std::uint8_t*>(&sum), sizeof sum});
  temporary.move_to(file);
}

}  // namespace scene_analyzer::gpu
