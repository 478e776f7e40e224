// replace.h — A file's contents replaced in one step: whoever looks finds the old file or the new one, whole.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string_view>

namespace scene_analyzer::files {

// What it means when the folder cannot be synced after the rename.
enum class FolderSync {
  kIfPossible,  // nothing: the new file stays, but after a power failure the old one may be back
  kRequired     // failure: the new file is removed, so that an error means "not stored", also after a power
                // failure. The old file is gone then, too
};

struct ReplaceOptions {
  mode_t mode = 0666;       // permissions of the new file, under the process's umask
  bool exact_mode = false;  // `mode` whatever the umask
  FolderSync folder_sync = FolderSync::kIfPossible;
};

// The same in pieces, for what is larger than memory should hold.
class Replacement {
 public:
  // Creates the temporary file. Throws std::system_error, as all members do.
  explicit Replacement(std::filesystem::path target, const ReplaceOptions& options = {});
  ~Replacement();  // removes what was not committed
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  void write(std::string_view bytes);
  // Makes it the target, once.
  void commit();

 private:
  class Temporary;
  const std::filesystem::path target_;
  const ReplaceOptions options_;
  const std::unique_ptr<Temporary> temporary_;
};

// Writes `bytes` to a temporary name beside `target`, syncs, renames it to `target` and syncs the folder.
// Killed at any moment it leaves the old file or the new one, and at most a file that is_temporary_name()
// knows. A symbolic link at `target` is replaced itself; the folder has to exist.
// Throws std::system_error with the system's reason; then nothing is left behind and the old file is
// untouched (the one exception: FolderSync::kRequired).
void replace(const std::filesystem::path& target, std::string_view bytes, const ReplaceOptions& options = {});

// For the thread that ends the process while others may be writing: removes their temporary files. A
// replace() that begins after it never comes back.
void forbid_and_remove_temporaries();

}  // namespace scene_analyzer::files
