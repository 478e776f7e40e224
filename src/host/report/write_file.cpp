// write_file.cpp — A report is on disk whole or not at all.
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "base/error.h"
#include "files/file.h"
#include "files/replace.h"
#include "report/report.h"

namespace scene_analyzer::report {
namespace {

namespace fs = std::filesystem;
using Producer = std::function<void(const Sink& sink)>;

[[noreturn]] void fail(const fs::path& path, int error) {
  throw InputError("cannot write " + path.string() + ": " + std::generic_category().message(error));
}

// Devices and pipes cannot be replaced, and must not be: renaming over /dev/null would break the machine.
void write_in_place(const fs::path& path, const Producer& produce) {
  files::File file = files::File::open_for_writing(path);
  produce([&](std::string_view bytes) { file.write(bytes); });
  file.close();
}

void replace(const fs::path& path, const struct stat* existing, const Producer& produce) {
  files::ReplaceOptions options;
  if (existing) {
    options.mode = existing->st_mode & 0777;
    options.exact_mode = true;
  }
  files::Replacement replacement(path, options);
  produce([&](std::string_view bytes) { replacement.write(bytes); });
  replacement.commit();
}

// What write() throws of the system's becomes words for users.
template <typename Write>
void attempt(const fs::path& path, const Write& write) {
  try {
    write();
  } catch (const std::system_error& error) {
    fail(path, error.code().value());
  }
}

}  // namespace

void write_file(const fs::path& path, const std::string& contents) {
  write_file(path, [&](const Sink& sink) { sink(contents); });
}

void write_file(const fs::path& path, const Producer& produce) {
  if (path == "-") {
    std::fflush(stdout);
    return attempt("standard output",
                   [&] { produce([](std::string_view bytes) { files::write_all(STDOUT_FILENO, bytes); }); });
  }
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail(path, errno);
  if (exists && S_ISDIR(status.st_mode)) fail(path, EISDIR);
  if (exists && !S_ISREG(status.st_mode)) return attempt(path, [&] { write_in_place(path, produce); });

  // A symbolic link stays one: its target is replaced.
  std::error_code error;
  const fs::path target = exists ? fs::canonical(path, error) : path;
  if (error) fail(path, error.value());
  attempt(target, [&] { replace(target, exists ? &status : nullptr, produce); });
}

}  // namespace scene_analyzer::report
