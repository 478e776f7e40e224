// file.h — Files as the rooms need them: whole writes, streamed reads, the system's reason in every error.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

namespace scene_analyzer::files {

// An open file descriptor. Every member throws std::system_error with the system's reason and repeats
// interrupted calls.
class File {
 public:
  // Only regular files: a device could block or have no end. Anything else: std::system_error (EISDIR, or
  // EINVAL).
  static File open_regular(const std::filesystem::path& path);
  // For devices and pipes, which are written in place; a file would be overwritten from its beginning.
  static File open_for_writing(const std::filesystem::path& path);
  // A file that did not exist before, `mode` under the process's umask. EEXIST when it did.
  static File create(const std::filesystem::path& path, mode_t mode = 0666);

  File(File&& other) noexcept;
  File& operator=(File&&) = delete;
  ~File();

  std::uint64_t size() const;
  // Fills `bytes` from the current position as far as the file goes; returns how many were read.
  std::size_t read(std::span<char> bytes);
  void write(std::string_view bytes);  // all of them
  void set_mode(mode_t mode);          // permissions, whatever the umask
  void sync();
  void close();  // network file systems report late failures here

 private:
  explicit File(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

// All of `bytes`, to a descriptor that stays the caller's. Throws std::system_error, as File does.
void write_all(int descriptor, std::string_view bytes);

// The reason in words, without a path.
std::string describe(const std::error_code& code);

// Makes a rename in `folder` (empty: the working folder) durable. File systems that cannot sync folders are
// accepted, and so is a folder that may be written but not read: what it holds is still whole or absent.
// Throws std::system_error.
void sync_folder(const std::filesystem::path& folder);

}  // namespace scene_analyzer::files
