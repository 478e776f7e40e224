// asset_io.h — Assimp's way to the disk: only reading, only files that AssetFiles lets through.
#pragma once

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "import/asset_files.h"

namespace scene_analyzer::import {

class AssetIo : public Assimp::DefaultIOSystem {
 public:
  // `replacement`, when not empty, is read in place of the asset itself. Both outlive the object.
  AssetIo(AssetFiles& files, std::string_view replacement) : files_(files), replacement_(replacement) {}

  bool Exists(const char* file) const override { return !find(file).path.empty(); }

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (mode == nullptr || mode[0] != 'r') return nullptr;
    const AssetFiles::Found found = find(file);
    if (!replacement_.empty() && found.path == "./" + files_.asset_path())
      return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(replacement_.data()),
                                        replacement_.size());
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
  std::string_view replacement_;
};

}  // namespace scene_analyzer::import
