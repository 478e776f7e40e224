// cache_file.h — Files that only save time: written atomically with a checksum, made anew when they are
// damaged. Vulkan-free.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace scene_analyzer::gpu {

// The data written last; empty when the file is absent, or damaged, which a warning says. `what` names the
// kind of file in messages: "pipeline cache".
std::vector<std::uint8_t> read_cache_file(const std::filesystem::path& file, const std::string& what);

// Replaces the file, synced to disk, and makes its folder when there is none. Throws std::system_error that
// names the file.
void write_cache_file(const std::filesystem::path& file, const std::string& what,
                      std::span<const std::uint8_t> data);

std::uint64_t cache_checksum(std::span<const std::uint8_t> data);

}  // namespace scene_analyzer::gpu
