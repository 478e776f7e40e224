#include "files/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace scene_analyzer::files {
namespace {

[[noreturn]] void fail(int error) {
  throw std::system_error(error, std::generic_category());
}

void require_regular(const struct stat& status) {
  if (S_ISDIR(status.st_mode)) fail(EISDIR);
  if (!S_ISREG(status.st_mode)) fail(EINVAL);
}

int open_repeated(const std::filesystem::path& path, int flags, mode_t mode = 0) {
  int descriptor = -1;
  do descriptor = ::open(path.c_str(), flags | O_CLOEXEC, mode);
  while (descriptor < 0 && errno == EINTR);
  return descriptor;
}

}  // namespace

File File::open_regular(const std::filesystem::path& path) {
  // Asked before opening, because opening alone acts on some devices, and again after, because names can
  // change.
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) fail(errno);
  require_regular(status);
  const int descriptor = open_repeated(path, O_RDONLY | O_NONBLOCK | O_NOCTTY);
  if (descriptor < 0) fail(errno);
  File file(descriptor);
  if (::fstat(descriptor, &status) != 0) fail(errno);
  require_regular(status);
  return file;
}

File File::open_for_writing(const std::filesystem::path& path) {
  const int descriptor = open_repeated(path, O_WRONLY);
  if (descriptor < 0) fail(errno);
  return File(descriptor);
}

File File::create(const std::filesystem::path& path, mode_t mode) {
  const int descriptor = open_repeated(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, mode);
  if (descriptor < 0) fail(errno);
  return File(descriptor);
}

File::File(File&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

File::~File() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::uint64_t File::size() const {
  struct stat status = {};
  if (::fstat(descriptor_, &status) != 0) fail(errno);
  return static_cast<std::uint64_t>(status.st_size);
}

std::size_t File::read(std::span<char> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(descriptor_, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(errno);
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

void File::write(std::string_view bytes) {
  write_all(descriptor_, bytes);
}

void File::set_mode(mode_t mode) {
  if (::fchmod(descriptor_, mode) != 0) fail(errno);
}

void File::sync() {
  while (::fsync(descriptor_) != 0)
    if (errno != EINTR) fail(errno);
}

void File::close() {
  // Not repeated on EINTR: Linux has released the descriptor by then.
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0 && errno != EINTR) fail(errno);
}

void write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(errno);
    if (count == 0) fail(ENOSPC);  // no progress and no reason given: never loop on it
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

std::string describe(const std::error_code& code) {
  if (code == std::errc::is_a_directory) return "it is a folder";
  if (code == std::errc::invalid_argument) return "it is not a regular file";
  return code.message();
}

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = open_repeated(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
  if (descriptor < 0) {
    if (errno == EACCES) return;  // a folder may be writable without being readable
    fail(errno);
  }
  const bool synced = ::fsync(descriptor) == 0;
  const int error = errno;
  ::close(descriptor);
  if (!synced && error != EINVAL && error != ENOTSUP && error != EINTR) fail(error);
}

}  // namespace scene_analyzer::files
