// sandbox.h — What the worker gives up before it touches the asset.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>

namespace scene_analyzer::import {

// Address space, CPU seconds, no core file; dies with `parent`. Under AddressSanitizer, whose shadow needs
// terabytes, address space stays unlimited. Throws std::system_error.
void limit_this_process(std::uint64_t memory_bytes, std::uint64_t cpu_seconds, pid_t parent);

// From here on only reading below `folder`, and of `asset` itself, which may be a link. Where the kernel has
// no Landlock the names are still checked by AssetFiles. Throws std::system_error.
void allow_reading_only(const std::filesystem::path& folder, const std::filesystem::path& asset);

}  // namespace scene_analyzer::import
