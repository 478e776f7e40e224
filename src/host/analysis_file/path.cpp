#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>

#include "analysis_file/analysis_file.h"
#include "analysis_file/hash.h"

namespace scene_analyzer::analysis_file {
namespace {

constexpr std::string_view kSuffix = ".analysis";
constexpr std::string_view kFolderMark = ".d";
constexpr std::size_t kMaxComponent = 255;  // NAME_MAX of all file systems in use
constexpr std::size_t kHexDigits = 32;

// Whether a name already looks like what fitted() makes of a long one.
bool looks_shortened(std::string_view name) {
  if (name.size() < kHexDigits + 1 || name[name.size() - kHexDigits - 1] != '~') return false;
  const std::string_view digits = name.substr(name.size() - kHexDigits);
  return digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

// `name` + `suffix` as one path component. What would be too long keeps its beginning and gets a hash of the
// whole; so do names that look like that already, or a file could be made to share another's place.
std::string fitted(const std::string& name, std::string_view suffix) {
  if (name.size() + suffix.size() <= kMaxComponent && !looks_shortened(name))
    return name + std::string(suffix);
  std::size_t keep = std::min(name.size(), kMaxComponent - suffix.size() - kHexDigits - 1);
  // Not in the middle of a UTF-8 character: some file systems refuse such names.
  while (keep > 0 && keep < name.size() && (static_cast<unsigned char>(name[keep]) & 0xC0) == 0x80) --keep;
  return name.substr(0, keep) + "~" + to_hex(hash_of(name)) + std::string(suffix);
}

// A folder named like an analysis file would stand where the file of an asset beside it has to be: it gets a
// mark, and so do folders that look marked, so that different folders stay different.
std::string folder_component(const std::string& name) {
  std::string_view bare = name;
  while (bare.ends_with(kFolderMark)) bare.remove_suffix(kFolderMark.size());
  return fitted(name, bare.ends_with(kSuffix) ? kFolderMark : std::string_view{});
}

std::filesystem::path canonical_of(const std::filesystem::path& asset) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(asset, error);
  const std::filesystem::path& start = error ? asset : absolute;
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(start, error);
  // Unreadable parents: the name alone still tells assets apart.
  return error ? start.lexically_normal() : canonical;
}

}  // namespace

std::filesystem::path path_for(const std::filesystem::path& asset,
                               const std::optional<std::filesystem::path>& cache_folder) {
  if (!cache_folder) return asset.parent_path() / fitted(asset.filename().string(), kSuffix);
  const std::filesystem::path canonical = canonical_of(asset);
  std::filesystem::path place = *cache_folder;
  for (const auto& component : canonical.parent_path().relative_path())
    // Only where no canonical path could be had: nothing may climb out of the cache.
    place /= folder_component(component == ".." ? "~up" : component.string());
  return place / fitted(canonical.filename().string(), kSuffix);
}

}  // namespace scene_analyzer::analysis_file
