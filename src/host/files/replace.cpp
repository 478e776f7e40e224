#include "files/replace.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "files/file.h"
#include "files/temporary_name.h"

namespace scene_analyzer::files {
namespace {

namespace fs = std::filesystem;

constexpr int kNameAttempts = 16;

// A new file in `folder`; its path goes into `path`.
File create_temporary(const fs::path& folder, mode_t mode, fs::path& path) {
  for (int attempt = 1;; ++attempt) {
    path = folder / temporary_name();
    try {
      return File::create(path, mode);
    } catch (const std::system_error& error) {
      if (error.code() != std::errc::file_exists || attempt == kNameAttempts) throw;
    }
  }
}

// Removes the temporary file unless it was renamed.
class Temporary {
 public:
  Temporary(const fs::path& folder, const ReplaceOptions& options)
      : file_(create_temporary(folder, options.mode, path_)) {}
  ~Temporary() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void fill(std::string_view bytes, const ReplaceOptions& options) {
    if (options.exact_mode) file_.set_mode(options.mode);  // before there is anything to read
    file_.write(bytes);
    file_.sync();
    file_.close();
  }
  void rename_to(const fs::path& target) {
    if (::rename(path_.c_str(), target.c_str()) != 0) throw std::system_error(errno, std::generic_category());
    path_.clear();
  }

 private:
  fs::path path_;  // before the file, which fills it
  File file_;
};

}  // namespace

void replace(const fs::path& target, std::string_view bytes, const ReplaceOptions& options) {
  const fs::path folder = target.parent_path();
  Temporary temporary(folder, options);
  temporary.fill(bytes, options);
  temporary.rename_to(target);
  try {
    sync_folder(folder);
  } catch (const std::system_error&) {
    if (options.folder_sync == FolderSync::kIfPossible) return;
    ::unlink(target.c_str());
    throw;
  }
}

}  // namespace scene_analyzer::files
