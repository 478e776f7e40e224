#include "import/asset_files.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

namespace scene_analyzer::import {
namespace {

namespace fs = std::filesystem;

// Stands for the asset's folder where its files lie under other names: references with ".." lead out of it.
constexpr const char* kNamedFolder = "/asset";

bool is_url(std::string_view text) {
  const std::size_t colon = text.find("://");
  return colon != std::string_view::npos && colon > 1 &&
         std::all_of(text.begin(), text.begin() + colon, [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) || c == '+' || c == '-' || c == '.';
         });
}

bool has_drive_letter(std::string_view text) {
  return text.size() >= 2 && text[1] == ':' && std::isalpha(static_cast<unsigned char>(text[0]));
}

// To the system a name ends at its first NUL.
bool can_be_of_a_file(std::string_view name) {
  return name.find('\0') == std::string_view::npos;
}

bool is_file(const std::string& path) {
  std::error_code ignored;  // a name that cannot be looked up is not there
  return can_be_of_a_file(path) && fs::is_regular_file(path, ignored);
}

// Of a file that is there: whether links on the way to it lead out of `folder`, which is canonical.
bool leads_out(const fs::path& folder, const std::string& path) {
  std::error_code error;
  const fs::path target = fs::canonical(path, error);
  if (error) return true;
  const fs::path relative = target.lexically_relative(folder);
  return relative.empty() || *relative.begin() == "..";
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

Reference resolve_reference(const fs::path& folder, std::string_view text) {
  if (is_url(text)) return {Reference::Kind::kUrl, {}};
  std::string slashed(text);
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  if (slashed.starts_with('/') || has_drive_letter(slashed)) return {Reference::Kind::kOutside, {}};
  const fs::path relative = (folder / slashed).lexically_normal().lexically_relative(folder);
  if (relative.empty() || *relative.begin() == "..") return {Reference::Kind::kOutside, {}};
  return {Reference::Kind::kInside, relative.generic_string()};
}

std::string decode_percent(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
    if (low < 0) {
      decoded += text[i];
    } else {
      decoded += static_cast<char>(high * 16 + low);
      i += 2;
    }
  }
  return decoded;
}

AssetFiles::AssetFiles(std::string asset_name)
    : asset_(std::move(asset_name)), asset_path_(asset_), folder_(fs::current_path()) {
  record(asset_, true);
}

AssetFiles::AssetFiles(std::string asset_path, const mesh::FileNames& names)
    : asset_(names.at(0)), asset_path_(std::move(asset_path)), folder_(kNamedFolder), paths_(std::in_place) {
  for (std::size_t i = 1; i < names.size(); ++i) paths_->emplace(names[i], std::to_string(i));
  record(asset_, true);
}

std::string AssetFiles::path_of(const std::string& name) const {
  std::string path = name;
  if (paths_) {
    const auto entry = paths_->find(name);
    if (entry == paths_->end()) return {};
    path = entry->second;
  }
  return is_file(path) ? path : std::string();
}

AssetFiles::Found AssetFiles::look_up(std::string_view text) const {
  // The asset's own name is taken as it is: it may hold any character, and be a link to anywhere.
  if (text == asset_) return {Reference::Kind::kInside, "./" + asset_path_, asset_};
  Found found = look_up_name(text);
  if (found.path.empty() || paths_ || !leads_out(folder_, found.path)) return found;
  return {Reference::Kind::kOutside, {}, {}};
}

AssetFiles::Found AssetFiles::look_up_name(std::string_view text) const {
  const auto found = [this](const Reference& reference) -> Found {
    std::string path = reference.kind == Reference::Kind::kInside ? path_of(reference.path) : std::string();
    return {reference.kind, std::move(path), reference.path};
  };
  const Found plain = found(resolve_reference(folder_, text));
  if (plain.kind != Reference::Kind::kInside || !plain.path.empty()) return plain;
  if (text.find('%') != std::string_view::npos) {
    const Found decoded = found(resolve_reference(folder_, decode_percent(text)));
    // "%2e%2e/" is as much a way out as "../" is.
    if (decoded.kind != Reference::Kind::kInside || !decoded.path.empty()) return decoded;
  }
  return {Reference::Kind::kInside, {}, {}};
}

AssetFiles::Found AssetFiles::find(std::string_view text) {
  Found found = look_up(text);
  if (text == asset_) return found;
  if (found.kind != Reference::Kind::kInside)
    refused_.emplace(text);
  else if (found.path.empty())
    record_missing(text);
  else
    record(found.name, true);
  return found;
}

AssetFiles::Found AssetFiles::find_guess(std::string_view text) {
  Found found = look_up(text);
  if (!found.path.empty() && text != asset_) record(found.name, true);
  return found;
}

void AssetFiles::record(const std::string& name, bool found) {
  const auto [entry, is_new] = position_.try_emplace(name, files_.size());
  if (is_new) files_.push_back({name, found});
}

// Under every name that it would have been found by, so that its coming is noticed.
void AssetFiles::record_missing(std::string_view text) {
  const std::string name = resolve_reference(folder_, text).path;
  if (can_be_of_a_file(name)) record(name, false);
  const std::string decoded = resolve_reference(folder_, decode_percent(text)).path;
  if (decoded == name || !can_be_of_a_file(decoded)) return;
  record(decoded, false);
  decoded_.insert(decoded);
}

bool AssetFiles::readable(const std::string& path) {
  return !path.empty() && ::access(path.c_str(), R_OK) == 0;
}

std::vector<std::string> AssetFiles::missing_with_extension(std::string_view extension) const {
  std::vector<std::string> missing;
  for (const mesh::ReferencedFile& file : files_)
    if (!file.found && file.path.ends_with(extension) && !decoded_.contains(file.path))
      missing.push_back(file.path);
  return missing;
}

}  // namespace scene_analyzer::import
