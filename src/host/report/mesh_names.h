// mesh_names.h — How tables name meshes. What returns or takes printable text needs a UnicodeScope.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/analysis.h"

namespace scene_analyzer::report {

inline constexpr std::size_t kLeastNameWidth = 12;  // columns
inline constexpr std::size_t kMostNameWidth = 64;   // one absurd name must not blow up every row

// What stands before the names of an asset's meshes: nothing for a single asset, else its file name, or its
// path where two assets have that file name.
std::vector<std::string> asset_prefixes(std::span<const analysis::AssetAnalysis> assets);

// The node's name, or the mesh's where the node has none; printable, at most kMostNameWidth columns.
std::u32string shown_name(const std::string& prefix, const analysis::InstanceAnalysis& instance);

// UTF-8 of exactly `width` columns.
std::string padded_name(std::u32string_view name, std::size_t width);

std::string plural(std::uint64_t count, std::string_view singular, std::string_view many);

}  // namespace scene_analyzer::report
