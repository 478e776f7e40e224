// file_names.h — mesh::FileNames on the disk, for the import worker.
#pragma once

#include <filesystem>

#include "mesh/asset_source.h"

namespace scene_analyzer::import {

// In the asset's folder: the names, each with a zero byte behind it.
inline constexpr const char* kFileNames = "names";

// Throws std::system_error, also when there is such a file already.
void write_file_names(const std::filesystem::path& folder, const mesh::FileNames& names);
// At least one. Throws std::system_error, and InputError when it is no whole table of names.
mesh::FileNames read_file_names(const std::filesystem::path& folder);

}  // namespace scene_analyzer::import
