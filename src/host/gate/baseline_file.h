// baseline_file.h — Baselines on disk: a JSON file per asset below a folder, to be kept in version control.
//
// Nothing in it depends on the machine: files lie under the asset's portable_path(), which they also name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "gate/baseline.h"

namespace scene_analyzer::gate {

// `folder`/props/chair.glb.json. Different paths of assets give different places, all below the folder.
std::filesystem::path baseline_place(const std::filesystem::path& folder, const std::string& asset);

// Creates missing folders. The same baseline gives the same bytes. Throws InputError.
void write_baseline(const std::filesystem::path& folder, const AssetBaseline& baseline);

// Nothing where there is none. Throws UsageError for what is no baseline of that asset.
std::optional<AssetBaseline> read_baseline(const std::filesystem::path& folder, const std::string& asset);

// Throws UsageError where values of both cannot be compared: other parameters, weights or eye.
void require_comparable(const AssetBaseline& before, const AssetBaseline& now);

}  // namespace scene_analyzer::gate
