#include "import/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace scene_analyzer::import {

MappedFile::MappedFile(const std::string& path) {
  const auto fail = [&] { throw std::system_error(errno, std::generic_category(), path); };
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail();
  struct stat state {};
  const bool known = ::fstat(descriptor, &state) == 0;
  void* address = nullptr;
  if (known && state.st_size > 0)
    address = ::mmap(nullptr, static_cast<std::size_t>(state.st_size), PROT_READ, MAP_PRIVATE, descriptor, 0);
  const int error = errno;
  ::close(descriptor);
  errno = error;
  if (!known || address == MAP_FAILED) fail();
  if (address != nullptr)
    bytes_ = {static_cast<const std::uint8_t*>(address), static_cast<std::size_t>(state.st_size)};
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::uint8_t*>(bytes_.data()), bytes_.size());
}

}  // namespace scene_analyzer::import
