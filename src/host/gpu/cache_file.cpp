#include "gpu/cache_file.h"

#include <spdlog/spdlog.h>
#include <xxhash.h>

#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

#include "files/file.h"
#include "files/replace.h"

namespace scene_analyzer::gpu {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

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

}  // namespace

std::uint64_t cache_checksum(std::span<const std::uint8_t> data) {
  return XXH3_64bits(data.data(), data.size());
}

Bytes read_cache_file(const fs::path& file, const std::string& what) {
  auto contents = read_whole(file);
  if (!contents) return {};
  Bytes& bytes = *contents;
  std::uint64_t stored = 0;
  if (bytes.size() > sizeof stored) {
    std::memcpy(&stored, bytes.data() + bytes.size() - sizeof stored, sizeof stored);
    bytes.resize(bytes.size() - sizeof stored);
    if (cache_checksum(bytes) == stored) return std::move(bytes);
  }
  spdlog::warn("the {} {} is damaged and will be made anew", what, file.string());
  return {};
}

void write_cache_file(const fs::path& file, const std::string& what, std::span<const std::uint8_t> data) {
  const std::uint64_t sum = cache_checksum(data);
  fs::create_directories(file.parent_path());
  std::string bytes(reinterpret_cast<const char*>(data.data()), data.size());
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  try {
    files::replace(file, bytes, {.mode = 0600});
  } catch (const std::system_error& error) {
    throw std::system_error(error.code(), "writing the " + what + " " + file.string());
  }
}

}  // namespace scene_analyzer::gpu
