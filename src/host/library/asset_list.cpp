#include "library/asset_list.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <set>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "import/import.h"

namespace scene_analyzer::library {
namespace {

namespace fs = std::filesystem;

// Extensions of Assimp's that other programs use for other things, and of formats without any mesh.
constexpr std::array<std::string_view, 11> kAmbiguous = {
    "xml", "raw", "prj", "mot", "bvh", "md5anim", "uc", "ter", "md5camera", "scn", "mesh.xml"};

bool any_matches(std::string_view text, const std::vector<std::string>& globs) {
  return std::ranges::any_of(globs, [&](const std::string& glob) { return matches(text, glob); });
}

bool is_wanted(const std::string& below, const Filter& filter) {
  const bool included =
      filter.include.empty() ? has_asset_extension(below) : any_matches(below, filter.include);
  return included && !any_matches(below, filter.exclude);
}

std::uint64_t bytes_of(const fs::path& file) {
  std::error_code unknown;  // whoever opens it says why
  const std::uintmax_t bytes = fs::file_size(file, unknown);
  return unknown ? 0 : bytes;
}

class Search {
 public:
  Search(const Filter& filter, std::vector<ListedAsset>& found) : filter_(filter), found_(found) {}

  void run(const fs::path& folder) {
    root_ = folder.lexically_normal();
    if (root_ == ".") root_.clear();  // "chair.glb" reads better than "./chair.glb"
    std::error_code error;
    fs::recursive_directory_iterator entry(root_.empty() ? "." : root_, error);
    const fs::recursive_directory_iterator end;
    for (; !error && entry != end; entry.increment(error)) {
      if (entry->path().filename().native().starts_with('.')) {
        entry.disable_recursion_pending();
        continue;
      }
      visit(*entry);
    }
    if (error) throw UsageError(fmt::format("{}: cannot be searched: {}", folder.string(), error.message()));
  }

 private:
  void visit(const fs::directory_entry& entry) {
    std::error_code ignored;  // what cannot be looked at is no regular file
    if (!entry.is_regular_file(ignored)) return;
    const fs::path below = entry.path().lexically_relative(root_.empty() ? "." : root_);
    if (is_wanted(below.generic_string(), filter_))
      found_.push_back({(root_ / below).string(), bytes_of(entry.path())});
  }

  const Filter& filter_;
  std::vector<ListedAsset>& found_;
  fs::path root_;
};

void read_list(std::istream& lines, const std::string& name, std::vector<ListedAsset>& found) {
  std::string line;
  while (std::getline(lines, line)) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) continue;
    if (line.find('\0') != std::string::npos)
      throw UsageError(fmt::format(
          "{}: is no list of assets: it holds bytes that no path can have; name assets with their extension, "
          "or write one path per line",
          name));
    found.push_back({line, bytes_of(line)});
  }
  if (lines.bad()) throw UsageError(fmt::format("{}: cannot be read to its end", name));
}

void add(const std::string& input, const Filter& filter, std::istream& standard_input,
         std::vector<ListedAsset>& found) {
  if (input == "-") return read_list(standard_input, "standard input", found);
  std::error_code error;
  const fs::file_status status = fs::status(input, error);
  if (status.type() == fs::file_type::not_found)
    throw UsageError(fmt::format("'{}' does not exist; name a folder, an asset or a list of assets", input));
  if (error) throw UsageError(fmt::format("{}: cannot be read: {}", input, error.message()));
  if (fs::is_directory(status)) return Search(filter, found).run(input);
  if (has_asset_extension(input)) {
    found.push_back({input, bytes_of(input)});
    return;
  }
  std::ifstream file(input, std::ios::binary);
  if (!file) throw UsageError(fmt::format("{}: cannot be read", input));
  read_list(file, input, found);
}

}  // namespace

bool matches(std::string_view text, const std::string& glob) {
  return ::fnmatch(glob.c_str(), std::string(text).c_str(), 0) == 0;
}

bool has_asset_extension(const fs::path& file) {
  static const std::set<std::string, std::less<>> known = [] {
    std::set<std::string, std::less<>> extensions = import::known_extensions();
    for (const std::string_view ambiguous : kAmbiguous) extensions.erase(std::string(ambiguous));
    return extensions;
  }();
  std::string extension = file.extension().string();
  if (extension.empty()) return false;
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return known.contains(std::string_view(extension).substr(1));
}

std::vector<ListedAsset> list_assets(const std::vector<std::string>& inputs, const Filter& filter,
                                     std::istream& standard_input) {
  std::vector<ListedAsset> found;
  for (const std::string& input : inputs) add(input, filter, standard_input, found);
  std::ranges::sort(found, {}, &ListedAsset::path);
  const auto repeated =
      std::unique(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.path == b.path; });
  found.erase(repeated, found.end());
  return found;
}

}  // namespace scene_analyzer::library
