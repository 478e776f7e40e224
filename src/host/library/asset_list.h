// asset_list.h — Which assets a library holds: folders, assets by name, lists of names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace scene_analyzer::library {

// Which files of a folder are assets. Globs are matched against the path below the folder: `*` stands for any
// characters, `/` included, `?` for one, `[abc]` for one of these.
struct Filter {
  std::vector<std::string> include;  // instead of the extensions of known formats; empty: those
  std::vector<std::string> exclude;  // wins over include
};

struct ListedAsset {
  std::string path;         // below the folder as that was given, or as the list names it
  std::uint64_t bytes = 0;  // of the file itself; 0 where it cannot be told
  bool operator==(const ListedAsset&) const = default;
};

struct AssetList {
  std::vector<ListedAsset> assets;  // ascending by path, each file once
  std::uint64_t repeated = 0;       // names that were left out, since another one leads to the same file
};

// Of the file, or of what a link leads to; 0 where it cannot be told.
std::uint64_t bytes_of(const std::filesystem::path& file);

// Whether `text` matches `glob` as a whole.
bool matches(std::string_view text, const std::string& glob);

// Whether a folder's file of that name is taken for an asset: Assimp's extensions, in any case, less those
// that mostly belong to other files (.xml, .raw, .prj and the like), which --include brings back.
bool has_asset_extension(const std::filesystem::path& file);

// The assets of `inputs`. A folder is searched with everything below it; hidden files and folders (.git) and
// what links to folders are passed by. Of several names of one file, by links or in other spellings, the
// first that is no link stands for all. A file with an asset's extension is an asset, whatever the filter;
// any other file is a list of assets, one path per line, relative to the working folder, blank lines aside;
// "-" is such a list on `standard_input`. Listed assets need not exist: that is found out, and said, when
// they are analysed, and so it is for links that lead nowhere. Throws UsageError for an input that does not
// exist and for a folder or list that cannot be read. Cost: n log n in assets.
AssetList list_assets(const std::vector<std::string>& inputs, const Filter& filter,
                      std::istream& standard_input);

}  // namespace scene_analyzer::library
