// asset_io.h — Assimp's way to the disk: only reading, only files that AssetFiles lets through.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <algorithm>
#include <string_view>

#include "import/asset_files.h"

namespace scene_analyzer::import {

class AssetIo : public Assimp::DefaultIOSystem {
 public:
  explicit AssetIo(AssetFiles& files) : files_(files) {}

  bool Exists(const char* file) const override { return !find(file).path.empty(); }

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (mode == nullptr || mode[0] != 'r') return nullptr;
    const AssetFiles::Found found = find(file);
    return found.path.empty() ? nullptr : DefaultIOSystem::Open(found.path.c_str(), mode);
  }

 private:
  // Importers put the asset's folder, "./", in front of what the file says. When that does not exist,
  // Assimp's file system filter tries pieces of the name below ".//".
  AssetFiles::Found find(std::string_view name) const {
    while (name.starts_with("./")) name.remove_prefix(2);
    if (!name.starts_with('/')) return files_.find(name);
    return files_.find_guess(name.substr(std::min(name.size(), name.find_first_not_of('/'))));
  }

  AssetFiles& files_;
};

}  // namespace scene_analyzer::import
