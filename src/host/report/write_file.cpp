// write_file.cpp — A report is on disk whole or not at all.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "base/error.h"
#include "report/report.h"

namespace scene_analyzer::report {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int error) {
  throw InputError("cannot write " + path.string() + ": " + std::generic_category().message(error));
}

// 0 or the error.
int write_all(int descriptor, const std::string& contents) {
  std::size_t written = 0;
  while (written < contents.size()) {
    const ssize_t count = ::write(descriptor, contents.data() + written, contents.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    written += static_cast<std::size_t>(count);
  }
  return 0;
}

// Devices and pipes cannot be replaced, and must not be: renaming over /dev/null would break the machine.
void write_in_place(const fs::path& path, const std::string& contents) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(path, errno);
  int error = write_all(descriptor, contents);
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error != 0) fail(path, error);
}

// A name beside `path` that nobody has; the file exists and is open afterwards.
int open_temporary(const fs::path& path, fs::path& temporary) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    // Not the target's name with a suffix: that could exceed the longest name that the file system allows.
    temporary = path.parent_path() /
                (".scene-analyzer-" + std::to_string(::getpid()) + '-' + std::to_string(attempt) + ".tmp");
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return descriptor;
    if (errno != EEXIST) fail(path, errno);
  }
  fail(path, EEXIST);
}

// The rename itself is durable only once the folder is on disk; folders that cannot be synced do not fail the
// report.
void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

void replace(const fs::path& path, const struct stat* existing, const std::string& contents) {
  fs::path temporary;
  const int descriptor = open_temporary(path, temporary);
  int error = write_all(descriptor, contents);
  if (error == 0 && existing && ::fchmod(descriptor, existing->st_mode & 0777) != 0) error = errno;
  if (error == 0 && ::fsync(descriptor) != 0) error = errno;
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    fail(path, error);
  }
  sync_folder(path.parent_path());
}

}  // namespace

void write_file(const fs::path& path, const std::string& contents) {
  if (path == "-") {
    std::fflush(stdout);
    if (const int error = write_all(STDOUT_FILENO, contents)) fail("standard output", error);
    return;
  }
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail(path, errno);
  if (exists && S_ISDIR(status.st_mode)) fail(path, EISDIR);
  if (exists && !S_ISREG(status.st_mode)) return write_in_place(path, contents);

  // A symbolic link stays one: its target is replaced.
  std::error_code error;
  const fs::path target = exists ? fs::canonical(path, error) : path;
  if (error) fail(path, error.value());
  replace(target, exists ? &status : nullptr, contents);
}

}  // namespace scene_analyzer::report
