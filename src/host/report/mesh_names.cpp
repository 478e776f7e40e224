#include "report/mesh_names.h"

#include <fmt/format.h>

#include <filesystem>
#include <unordered_map>

#include "report/terminal_text.h"

namespace scene_analyzer::report {

std::vector<std::string> asset_prefixes(std::span<const analysis::AssetAnalysis> assets) {
  std::vector<std::string> prefixes(assets.size());
  if (assets.size() < 2) return prefixes;
  std::unordered_map<std::string, int> uses;
  for (const auto& asset : assets) ++uses[std::filesystem::path(asset.asset).filename().string()];
  for (std::size_t i = 0; i < assets.size(); ++i) {
    const std::string file = std::filesystem::path(assets[i].asset).filename().string();
    prefixes[i] = (uses[file] > 1 ? assets[i].asset : file) + ": ";
  }
  return prefixes;
}

std::u32string shown_name(const std::string& prefix, const analysis::InstanceAnalysis& instance) {
  std::string name = instance.node.empty() ? instance.mesh : instance.node;
  if (name.empty()) name = "(unnamed)";
  return shortened(printable(prefix + name), kMostNameWidth);
}

std::string padded_name(std::u32string_view name, std::size_t width) {
  const std::u32string fitting = shortened(name, width);
  return encode_utf8(fitting) + std::string(width - columns(fitting), ' ');
}

std::string plural(std::uint64_t count, std::string_view singular, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? singular : many);
}

}  // namespace scene_analyzer::report
