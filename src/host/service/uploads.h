// uploads.h — Files that clients send: in a private folder, within a quota, as long as their request lasts.
//
//   FOLDER/scene-analyzer-uploads-XXXXXX/      of one running service, mode 0700, locked while that service lives
//     17/                                      one request
//       0.gltf, 1, 2, ...                      its files: the asset with the extension of its format, the others
//       names                                  what the asset calls them (import/file_names.h)
//
// What clients call their files is never part of a path.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>

#include "files/file.h"
#include "mesh/asset_source.h"

namespace scene_analyzer::service {

inline constexpr std::size_t kMostFiles = 10'000;      // of one upload
inline constexpr std::size_t kLongestFileName = 1024;  // bytes

class UploadSpace {
 public:
  // Below `parent`, of which it also removes what services have left that were killed. `quota_bytes` are for
  // all uploads together; a file counts as at least 4096 bytes. Throws UsageError with the system's reason.
  UploadSpace(const std::filesystem::path& parent, std::uint64_t quota_bytes);
  ~UploadSpace();
  UploadSpace(const UploadSpace&) = delete;
  UploadSpace& operator=(const UploadSpace&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  std::uint64_t used_bytes() const;

 private:
  friend class Upload;
  std::filesystem::path make_folder();
  bool take(std::uint64_t bytes);
  void give_back(std::uint64_t bytes);

  std::filesystem::path folder_;
  int lock_ = -1;
  const std::uint64_t quota_bytes_;
  mutable std::mutex mutex_;
  std::uint64_t used_bytes_ = 0, made_ = 0;
};

// The files of one request. Destroying it removes them.
class Upload {
 public:
  // `space` must outlive it; `most_bytes` are for all files of this upload. Throws Refusal, as all members
  // do: kInvalid, kTooLarge, kBusy where the quota is used up or the disk is full.
  Upload(UploadSpace& space, std::uint64_t most_bytes);
  ~Upload();
  Upload(const Upload&) = delete;
  Upload& operator=(const Upload&) = delete;

  // The first file is the asset. `size`: how many bytes will follow, where that is known.
  void begin_file(std::string_view name, std::optional<std::uint64_t> size);
  void add(std::string_view bytes);  // to the file begun last
  // No more files follow.
  mesh::AssetSource finish();

 private:
  std::string checked_name(std::string_view name) const;
  void end_file();
  void reserve(std::uint64_t bytes);

  UploadSpace& space_;
  const std::uint64_t most_bytes_;
  std::filesystem::path folder_;
  std::filesystem::path asset_;
  std::shared_ptr<mesh::FileNames> names_ = std::make_shared<mesh::FileNames>();
  std::unordered_set<std::string> known_;
  std::optional<files::File> file_;
  std::optional<std::uint64_t> announced_;  // of the open file
  std::uint64_t written_ = 0;               // of the open file
  std::uint64_t bytes_ = 0;                 // of all
  std::uint64_t reserved_ = 0;              // of the quota
};

}  // namespace scene_analyzer::service
