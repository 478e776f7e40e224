// file_io.h — Files as this room needs them: whole writes, streamed reads, the system's reason in every
// error.
#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

namespace scene_analyzer::analysis_file {

// An open file descriptor. Every member throws std::system_error with the system's reason and repeats
// interrupted calls.
class File {
 public:
  // Only regular files: a device could block or have no end. Anything else: std::system_error (EISDIR, or
  // EINVAL).
  static File open_regular(const std::filesystem::path& path);
  // A file that did not exist before, mode 0666 under the process's umask. EEXIST when it did.
  static File create(const std::filesystem::path& path);

  File(File&& other) noexcept;
  File& operator=(File&&) = delete;
  ~File();

  std::uint64_t size() const;
  // Fills `bytes` from the current position as far as the file goes; returns how many were read.
  std::size_t read(std::span<char> bytes);
  void write(std::string_view bytes);  // all of them
  void sync();
  void close();  // network file systems report late failures here

 private:
  explicit File(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

// The reason in words, without a path.
std::string describe(const std::error_code& code);

// Makes a rename in `folder` durable. File systems that cannot sync folders are accepted: what they hold is
// still whole or absent.
void sync_folder(const std::filesystem::path& folder);

}  // namespace scene_analyzer::analysis_file
