// numbered_files.h — The same asset twice: under its files' true names, and under numbers with a table of
// names.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mesh/asset_source.h"
#include "support/temporary_folder.h"

namespace scene_analyzer {

// Names and contents, the asset first.
using NamedContents = std::vector<std::pair<std::string, std::string>>;

inline std::filesystem::path write_named(const TemporaryFolder& folder, const NamedContents& files) {
  for (const auto& [name, contents] : files) {
    std::filesystem::create_directories((folder.path() / name).parent_path());
    folder.write(name, contents);
  }
  return folder.path() / files.front().first;
}

// Without import::kFileNames, which the import's worker reads.
inline mesh::AssetSource write_numbered(const TemporaryFolder& folder, const NamedContents& files) {
  auto names = std::make_shared<mesh::FileNames>();
  const std::string extension = std::filesystem::path(files.front().first).extension().string();
  for (const auto& [name, contents] : files) {
    folder.write(std::to_string(names->size()) + (names->empty() ? extension : ""), contents);
    names->push_back(name);
  }
  return {folder.path() / ("0" + extension), std::shared_ptr<const mesh::FileNames>(names)};
}

}  // namespace scene_analyzer
