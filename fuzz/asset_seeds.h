// asset_seeds.h — Small valid assets in many formats: by the builders of the tests and by Assimp's exporters.
#pragma once

#include <string>
#include <vector>

namespace scene_analyzer::fuzz {

struct SeedAsset {
  std::string extension;  // with its dot
  std::string bytes;
};

// The same in every run of one version of Assimp. Each is imported with at least one triangle.
std::vector<SeedAsset> seed_assets();

}  // namespace scene_analyzer::fuzz
