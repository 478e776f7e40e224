// asset_files.h — The files an asset is made of. Whoever opens one, Assimp or a check, asks here for its path
// first.
//
// Every name that is asked for is recorded, found or not, because the result depends on it; names that lead
// out of the asset's folder, by themselves or through links, are refused.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "mesh/asset_source.h"
#include "mesh/scene.h"

namespace scene_analyzer::import {

// Where a reference of an asset leads.
struct Reference {
  enum class Kind { kInside, kOutside, kUrl };
  Kind kind = Kind::kInside;
  std::string path;  // kInside: normalised, relative to the folder, '/' between parts
};

// `folder` is absolute and normalised. Backslashes count as separators; absolute paths (also "C:...") are
// outside; ".." is fine as long as the path ends inside.
Reference resolve_reference(const std::filesystem::path& folder, std::string_view text);

// "%20" -> " "; escapes that are none stay as they are.
std::string decode_percent(std::string_view text);

class AssetFiles {
 public:
  // The folder is the current directory: names are opened relative to it. Throws
  // std::filesystem::filesystem_error.
  explicit AssetFiles(std::string asset_name);
  // The same where files lie under other names; the asset's own is `asset_path` there.
  AssetFiles(std::string asset_path, const mesh::FileNames& names);

  // The asset's own name below its folder,
  const std::string& asset_name() const { return asset_; }
  // and to open it. The same unless files lie under other names.
  const std::string& asset_path() const { return asset_path_; }

  struct Found {
    Reference::Kind kind = Reference::Kind::kInside;
    std::string path;  // to open it, relative to the folder; empty when there is no such regular file or it
                       // is refused
    std::string name;  // what it is called, relative to the folder; where there is a path
  };
  // Looks a reference up (as it stands, then with '%' escapes decoded) and records the answer.
  Found find(std::string_view reference);
  // The same for a name that is only a guess: recorded when there is such a file.
  Found find_guess(std::string_view reference);

  // Whether `path`, as found, can be opened and not only seen.
  static bool readable(const std::string& path);

  const std::vector<mesh::ReferencedFile>& files() const {
    return files_;
  }  // in order of first use, the asset first
  const std::set<std::string>& refused() const {
    return refused_;
  }  // references leading elsewhere, as written
  // As the asset names them, escapes and all.
  std::vector<std::string> missing_with_extension(std::string_view extension) const;

 private:
  Found look_up(std::string_view reference) const;
  Found look_up_name(std::string_view reference) const;  // without regard to links
  std::string path_of(const std::string& name) const;    // empty when there is no such regular file
  void record(const std::string& name, bool found);
  void record_missing(std::string_view reference);

  std::string asset_, asset_path_;
  std::filesystem::path folder_;
  std::optional<std::unordered_map<std::string, std::string>> paths_;  // by name, where these differ
  std::vector<mesh::ReferencedFile> files_;
  std::unordered_map<std::string, std::size_t> position_;
  std::set<std::string> refused_;
  std::set<std::string> decoded_;  // other names of missing files, which nobody wrote
};

}  // namespace scene_analyzer::import
