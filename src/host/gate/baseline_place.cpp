#include <fmt/format.h>
#include <xxhash.h>

#include "gate/baseline_file.h"

namespace scene_analyzer::gate {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view kSuffix = ".json";
constexpr std::size_t kMostName = 255 - 2;  // NAME_MAX of all file systems in use, less the marks

// What would be too long keeps its beginning and gets a hash of the whole.
std::string fitted(const std::string& name) {
  if (name.size() + kSuffix.size() <= kMostName) return name;
  constexpr std::size_t kHexDigits = 32;
  const XXH128_hash_t hash = XXH3_128bits(name.data(), name.size());
  std::size_t keep = kMostName - kSuffix.size() - kHexDigits - 1;
  // Not in the middle of a UTF-8 character: some file systems refuse such names.
  while (keep > 0 && (static_cast<unsigned char>(name[keep]) & 0xC0) == 0x80) --keep;
  return fmt::format("{}~{:016x}{:016x}", name.substr(0, keep), hash.high64, hash.low64);
}

// `..` becomes a name, and names that begin like that one get a mark.
std::string component(const std::string& name) {
  if (name == "..") return "~up";
  return fitted(name.starts_with('~') ? "~" + name : name);
}

// A folder named like a baseline would stand where that of an asset beside it has to be.
std::string folder_component(const std::string& name) {
  std::string folder = component(name);
  if (folder.ends_with(kSuffix) || folder.ends_with('~')) folder += '~';
  return folder;
}

}  // namespace

fs::path baseline_place(const fs::path& folder, const std::string& asset) {
  const fs::path relative = fs::path(asset).relative_path();
  fs::path place = folder;
  for (const fs::path& parent : relative.parent_path()) place /= folder_component(parent.string());
  return place / (component(relative.filename().string()) + std::string(kSuffix));
}

}  // namespace scene_analyzer::gate
