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

// Whether `text` matches `glob` as a whole.
bool matches(std::string_view text, const std::string& glob);

// Whether a folder's file of that name is taken for an asset: Assimp's extensions, in any case, less those
// that mostly belong to other files (.xml, .raw, .prj and the like), which --include brings back.
bool has_asset_extension(const std::filesystem::path& file);

// The assets of `inputs`, ascending by path, each path once. A folder is searched with everything below it;
// hidden files and folders (.git) and what links to folders are passed by. A file with an asset's extension
// is an asset, whatever the filter; any other file is a list of assets, one path per line, relative to the
// working folder, blank lines aside; "-" is such a list on `standard_input`. Listed assets need not exist:
// that is found out, and said, when they are analysed. Throws UsageError for an input that does not exist and
// for a folder or list that cannot be read. Cost: n log n in assets.
std::vector<ListedAsset> list_assets(const std::vector<std::string>& inputs, const Filter& filter,
                                     std::istream& standard_input);

}  // namespace scene_analyzer::library
