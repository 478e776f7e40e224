// memory_file.h — A file without a name for a wire::Writer to write to.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <stdexcept>
#include <vector>

namespace scene_analyzer::import {

class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("test", 0)) {
    if (descriptor_ < 0) throw std::runtime_error("memfd_create");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  int descriptor() const { return descriptor_; }
  std::vector<std::byte> contents() const {
    std::vector<std::byte> bytes(static_cast<std::size_t>(lseek(descriptor_, 0, SEEK_END)));
    if (pread(descriptor_, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
      throw std::runtime_error("pread");
    return bytes;
  }

 private:
  int descriptor_;
};

}  // namespace scene_analyzer::import
