// root_folder.h — Assets that lie on the service's machine: below one folder, and nowhere else.
#pragma once

#include <filesystem>
#include <string_view>

#include "mesh/asset_source.h"

namespace scene_analyzer::service {

class RootFolder {
 public:
  // Throws UsageError when it is no folder that can be read.
  explicit RootFolder(const std::filesystem::path& folder);

  // The asset of that name, '/' between parts, called by its name below the folder. Names and links may lead
  // anywhere below it. Throws Refusal: kNotFound for what is not there, leads out of it, be it to come back,
  // or is no regular file, without telling these apart.
  mesh::AssetSource find(std::string_view name) const;

 private:
  std::filesystem::path folder_;  // canonical
};

}  // namespace scene_analyzer::service
