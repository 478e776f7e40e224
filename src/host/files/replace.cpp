#include "files/replace.h"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include "files/file.h"
#include "files/temporary_name.h"

namespace scene_analyzer::files {
namespace {

namespace fs = std::filesystem;

constexpr int kNameAttempts = 16;
constexpr std::chrono::milliseconds kLongestWait(100);

// Temporary files of this process. Never destroyed: threads may outlive main().
struct Temporaries {
  std::timed_mutex mutex;
  std::set<fs::path> paths;
};
Temporaries& temporaries() {
  static auto* const all = new Temporaries;
  return *all;
}

// A new file in `folder`; its path goes into `path`.
File create_temporary(const fs::path& folder, mode_t mode, fs::path& path) {
  Temporaries& all = temporaries();
  for (int attempt = 1;; ++attempt) {
    path = folder / temporary_name();
    try {
      const std::scoped_lock lock(all.mutex);
      File file = File::create(path, mode);
      all.paths.insert(path);
      return file;
    } catch (const std::system_error& error) {
      if (error.code() != std::errc::file_exists || attempt == kNameAttempts) throw;
    }
  }
}

}  // namespace

// Removes the temporary file unless it was renamed.
class Replacement::Temporary {
 public:
  Temporary(const fs::path& folder, const ReplaceOptions& options)
      : file_(create_temporary(folder, options.mode, path_)) {
    if (options.exact_mode) file_.set_mode(options.mode);  // before there is anything to read
  }
  ~Temporary() {
    const std::scoped_lock lock(temporaries().mutex);
    temporaries().paths.erase(path_);
    if (!renamed_) ::unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void write(std::string_view bytes) { file_.write(bytes); }
  void close() {
    file_.sync();
    file_.close();
  }
  void rename_to(const fs::path& target) {
    if (::rename(path_.c_str(), target.c_str()) != 0) throw std::system_error(errno, std::generic_category());
    renamed_ = true;
  }

 private:
  fs::path path_;  // before the file, which fills it
  bool renamed_ = false;
  File file_;
};

Replacement::Replacement(fs::path target, const ReplaceOptions& options)
    : target_(std::move(target)),
      options_(options),
      temporary_(std::make_unique<Temporary>(target_.parent_path(), options)) {}

Replacement::~Replacement() = default;

void Replacement::write(std::string_view bytes) {
  temporary_->write(bytes);
}

void Replacement::commit() {
  temporary_->close();
  temporary_->rename_to(target_);
  try {
    sync_folder(target_.parent_path());
  } catch (const std::system_error&) {
    if (options_.folder_sync == FolderSync::kIfPossible) return;
    ::unlink(target_.c_str());
    throw;
  }
}

void replace(const fs::path& target, std::string_view bytes, const ReplaceOptions& options) {
  Replacement replacement(target, options);
  replacement.write(bytes);
  replacement.commit();
}

void forbid_and_remove_temporaries() {
  Temporaries& all = temporaries();
  // For good. A disk that does not answer keeps it from others, and from this end of the process, too.
  if (!all.mutex.try_lock_for(kLongestWait)) return;
  for (const fs::path& path : all.paths) ::unlink(path.c_str());
}

}  // namespace scene_analyzer::files
