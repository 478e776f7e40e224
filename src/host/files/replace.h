// replace.h — A file's contents replaced in one step: whoever looks finds the old file or the new one, whole.
#pragma once

#include <sys/types.h>

#include <filesystem>
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

// Writes `bytes` to a temporary name beside `target`, syncs, renames it to `target` and syncs the folder.
// Killed at any moment it leaves the old file or the new one, and at most a file that is_temporary_name()
// knows. A symbolic link at `target` is replaced itself; the folder has to exist.
// Throws std::system_error with the system's reason; then nothing is left behind and the old file is
// untouched (the one exception: FolderSync::kRequired).
void replace(const std::filesystem::path& target, std::string_view bytes, const ReplaceOptions& options = {});

}  // namespace scene_analyzer::files
