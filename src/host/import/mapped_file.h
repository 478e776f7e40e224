// mapped_file.h — A file's bytes, read-only, without reading what nobody looks at.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace scene_analyzer::import {

class MappedFile {
 public:
  // Throws std::system_error. An empty file has no bytes.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(MappedFile&& other) noexcept : bytes_(other.bytes_) { other.bytes_ = {}; }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  MappedFile& operator=(MappedFile&&) = delete;

  std::span<const std::uint8_t> bytes() const { return bytes_; }
  std::string_view text() const { return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()}; }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace scene_analyzer::import
