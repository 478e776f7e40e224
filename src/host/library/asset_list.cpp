#include "library/asset_list.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <map>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "import/import.h"

namespace scene_analyzer::library {
namespace {

namespace fs = std::filesystem;

// Extensions of Assimp's that other programs use for other things, and of formats without any mesh.
constexpr std::array<std::string_view, 10> kAmbiguous = {"xml",     "raw", "prj", "mot",       "bvh",
                                                         "md5anim", "uc",  "ter", "md5camera", "scn"};

bool any_matches(std::string_view text, const std::vector<std::string>& globs) {
  return std::ranges::any_of(globs, [&](const std::string& glob) { return matches(text, glob); });
}

bool is_wanted(const std::string& below, const Filter& filter) {
  const bool included =
      filter.include.empty() ? has_asset_extension(below) : any_matches(below, filter.include);
  return included && !any_matches(below, filter.exclude);
}

struct Found {
  fs::path identity;  // the same for all names of a file
  bool is_link = false;
  ListedAsset asset;
};

// Collects names of assets. Most lie in few folders, each of which is resolved once.
class Collector {
 public:
  void add(const std::string& path, bool is_link) {
    std::error_code error;
    fs::path identity = is_link ? fs::canonical(path, error) : fs::path();
    if (!is_link || error) identity = in_its_folder(path);
    found_.push_back({std::move(identity), is_link, {path, bytes_of(path)}});
  }

  AssetList take() {
    std::ranges::sort(found_, [](const Found& a, const Found& b) {
      return std::tie(a.identity, a.is_link, a.asset.path) < std::tie(b.identity, b.is_link, b.asset.path);
    });
    AssetList list;
    const fs::path* former = nullptr;
    for (Found& found : found_) {
      const bool is_another = former == nullptr || *former != found.identity;
      former = &found.identity;
      if (is_another)
        list.assets.push_back(std::move(found.asset));
      else
        ++list.repeated;
    }
    std::ranges::sort(list.assets, {}, &ListedAsset::path);
    return list;
  }

 private:
  fs::path in_its_folder(const fs::path& path) {
    const auto [known, added] = folders_.try_emplace(path.parent_path());
    if (added) {
      const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
      std::error_code error;
      known->second = fs::weakly_canonical(folder, error);
      if (error) known->second = fs::absolute(folder, error).lexically_normal();
    }
    return known->second / path.filename();
  }

  std::map<fs::path, fs::path> folders_;  // as they really are
  std::vector<Found> found_;
};

class Search {
 public:
  Search(const Filter& filter, Collector& found) : filter_(filter), found_(found) {}

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
    std::error_code error;
    const fs::file_type type = entry.status(error).type();
    // What a link leads to may be gone, or out of reach; whoever reads it says so.
    const bool is_out_of_reach = error || type == fs::file_type::not_found;
    if (type != fs::file_type::regular && !is_out_of_reach) return;
    const fs::path below = entry.path().lexically_relative(root_.empty() ? "." : root_);
    if (is_wanted(below.generic_string(), filter_))
      found_.add((root_ / below).string(), entry.is_symlink(error));
  }

  const Filter& filter_;
  Collector& found_;
  fs::path root_;
};

void add_file(const std::string& path, Collector& found) {
  std::error_code error;
  found.add(path, fs::is_symlink(path, error));
}

void read_list(std::istream& lines, const std::string& name, Collector& found) {
  std::string line;
  while (std::getline(lines, line)) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) continue;
    if (line.find('\0') != std::string::npos)
      throw UsageError(fmt::format(
          "{}: is no list of assets: it holds bytes that no path can have; name assets with their extension, "
          "or write one path per line",
          name));
    add_file(line, found);
  }
  if (lines.bad()) throw UsageError(fmt::format("{}: cannot be read to its end", name));
}

void add(const std::string& input, const Filter& filter, std::istream& standard_input, Collector& found) {
  if (input == "-") return read_list(standard_input, "standard input", found);
  std::error_code error;
  const fs::file_status status = fs::status(input, error);
  if (status.type() == fs::file_type::not_found)
    throw UsageError(fmt::format("'{}' does not exist; name a folder, an asset or a list of assets", input));
  if (error) throw UsageError(fmt::format("{}: cannot be read: {}", input, error.message()));
  if (fs::is_directory(status)) return Search(filter, found).run(input);
  if (has_asset_extension(input)) return add_file(input, found);
  std::ifstream file(input, std::ios::binary);
  if (!file) throw UsageError(fmt::format("{}: cannot be read", input));
  read_list(file, input, found);
}

}  // namespace

std::uint64_t bytes_of(const fs::path& file) {
  std::error_code unknown;  // whoever opens it says why
  const std::uintmax_t bytes = fs::file_size(file, unknown);
  return unknown ? 0 : bytes;
}

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

AssetList list_assets(const std::vector<std::string>& inputs, const Filter& filter,
                      std::istream& standard_input) {
  Collector found;
  for (const std::string& input : inputs) add(input, filter, standard_input, found);
  return found.take();
}

}  // namespace scene_analyzer::library
