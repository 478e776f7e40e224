// sent_files.h — Uploads as clients send them, and what lies on the disk then.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "service/uploads.h"

namespace scene_analyzer::service {

inline constexpr std::uint64_t kPlenty = std::uint64_t{1} << 30;

// Everything below it, relative to it.
inline std::set<std::string> everything_below(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    names.insert(entry.path().lexically_relative(folder).string());
  return names;
}

inline void send(Upload& upload, std::string_view name, std::string_view bytes) {
  upload.begin_file(name, bytes.size());
  upload.add(bytes);
}

// The folder of a single upload.
inline std::filesystem::path only_upload(const UploadSpace& space) {
  std::vector<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::directory_iterator(space.folder()))
    if (entry.is_directory()) folders.push_back(entry.path());
  EXPECT_EQ(folders.size(), 1U);
  return folders.at(0);
}

}  // namespace scene_analyzer::service
