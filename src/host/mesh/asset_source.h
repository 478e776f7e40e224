// asset_source.h — Where the files of an asset lie, and what it is called. Plain data.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scene_analyzer::mesh {

// Names that an asset knows its files by, where they lie under others; the asset's own is the first. File i
// of the folder, from 1 on, has its number for a name. Relative to the asset's folder, normalised, with '/'
// between parts, no two alike; the first without '/'.
using FileNames = std::vector<std::string>;

struct AssetSource {
  // As it lies on the disk.
  AssetSource(std::filesystem::path path) : file(std::move(path)), name(file.string()) {}
  AssetSource(const char* path) : AssetSource(std::filesystem::path(path)) {}
  AssetSource(const std::string& path) : AssetSource(std::filesystem::path(path)) {}
  // The same, called otherwise.
  AssetSource(std::filesystem::path path, std::string called)
      : file(std::move(path)), name(std::move(called)) {}
  // With files under other names; `path` keeps the extension of the asset's name, which tells its format. The
  // folder also holds import::kFileNames.
  AssetSource(std::filesystem::path path, std::shared_ptr<const FileNames> names)
      : file(std::move(path)), name(names->front()), file_names(std::move(names)) {}

  std::filesystem::path file;  // of the asset
  std::string name;            // what messages and analyses call it
  std::shared_ptr<const FileNames> file_names;

  // The asset's file as fingerprints name it.
  std::string file_name() const { return file_names ? file_names->front() : file.filename().string(); }
};

}  // namespace scene_analyzer::mesh
