#include <algorithm>
#include <optional>
#include <system_error>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "analysis_file/analysis_file.h"
#include "analysis_file/codec.h"
#include "analysis_file/hash.h"
#include "analysis_file/little_endian.h"
#include "base/error.h"
#include "base/version.h"
#include "files/file.h"

namespace scene_analyzer::analysis_file {
namespace {

constexpr std::size_t kChunkBytes = 1 << 20;

// Throws std::system_error.
analysis::FileFingerprint read_fingerprint(const std::filesystem::path& path, std::string name) {
  files::File file = files::File::open_regular(path);
  std::vector<char> chunk(static_cast<std::size_t>(std::clamp<std::uint64_t>(file.size(), 1, kChunkBytes)));
  Hasher hasher;
  analysis::FileFingerprint fingerprint{std::move(name), true, 0, {}};
  while (const std::size_t count = file.read(chunk)) {
    hasher.add({chunk.data(), count});
    fingerprint.size += count;
  }
  fingerprint.hash = hasher.digest();
  return fingerprint;
}

// Whether a name that the asset gives leads out of the asset's folder: absolute, or with more ".." than
// folders before.
bool leaves_folder(const std::filesystem::path& name) {
  const std::filesystem::path normal = name.lexically_normal();
  return normal.is_absolute() || (!normal.empty() && *normal.begin() == "..");
}

// Where the files of an asset lie.
class Places {
 public:
  explicit Places(const mesh::AssetSource& asset) : folder_(asset.file.parent_path()) {
    if (!asset.file_names) return;
    numbers_.emplace();
    for (std::size_t i = 1; i < asset.file_names->size(); ++i) numbers_->emplace((*asset.file_names)[i], i);
  }
  // Nothing where there is no such name.
  std::optional<std::filesystem::path> find(const std::string& name) const {
    if (!numbers_) return folder_ / name;
    const auto entry = numbers_->find(name);
    if (entry == numbers_->end()) return std::nullopt;
    return folder_ / std::to_string(entry->second);
  }

 private:
  const std::filesystem::path folder_;
  std::optional<std::unordered_map<std::string, std::size_t>> numbers_;  // where files have numbers for names
};

analysis::FileFingerprint fingerprint_reference(const Places& places, const mesh::ReferencedFile& reference) {
  const analysis::FileFingerprint missing{reference.path, false, 0, {}};
  if (reference.path.find('\0') != std::string::npos) return missing;
  // An asset must not make us read files elsewhere that its import was not given: only those count there.
  if (leaves_folder(reference.path) && !reference.found) return missing;
  const auto place = places.find(reference.path);
  if (!place) return missing;
  try {
    return read_fingerprint(*place, reference.path);
  } catch (const std::system_error&) {
    return missing;  // unreadable and absent are the same to an analysis, and a later change of it is noticed
  }
}

void add_text(std::string& bytes, std::string_view text) {
  append(bytes, static_cast<std::uint64_t>(text.size()));
  bytes += text;
}

}  // namespace

std::vector<analysis::FileFingerprint> fingerprint(const mesh::AssetSource& asset,
                                                   const std::vector<mesh::ReferencedFile>& referenced) {
  const std::string own_name = asset.file_name();
  std::vector<analysis::FileFingerprint> fingerprints;
  try {
    fingerprints.push_back(read_fingerprint(asset.file, own_name));
  } catch (const std::system_error& error) {
    throw InputError("'" + asset.name + "' cannot be read: " + files::describe(error.code()));
  }
  std::unordered_set<std::string> seen = {
      own_name};  // importers list the asset itself, and shared textures twice
  const Places places(asset);
  for (const mesh::ReferencedFile& reference : referenced)
    if (!reference.path.empty() && seen.insert(reference.path).second)
      fingerprints.push_back(fingerprint_reference(places, reference));
  return fingerprints;
}

std::string content_key_of(const analysis::AssetAnalysis& analysis, std::string_view version) {
  std::string bytes;
  add_text(bytes, version);
  const analysis::Parameters& parameters = analysis.parameters;
  append(bytes, parameters.alpha_degrees + 0.0);  // -0 is 0
  append(bytes, parameters.dim);
  append(bytes, parameters.weld_tolerance + 0.0);
  append(bytes, std::uint32_t{0});  // where files from before rendering times had their rotations
  append(bytes, static_cast<std::uint64_t>(analysis.files.size()));
  for (const analysis::FileFingerprint& file : analysis.files) {
    add_text(bytes, file.path);
    append(bytes, static_cast<std::uint64_t>(file.found));
    append(bytes, file.size);
    append(bytes, file.hash[0]);
    append(bytes, file.hash[1]);
  }
  // Behind everything else, so that files from before this parameter keep their key.
  if (analysis.computed[analysis::index_of(analysis::Metric::kFourierTransform)])
    append(bytes, parameters.start_searches);
  return to_hex(hash_of(bytes));
}

std::string content_key(const analysis::AssetAnalysis& analysis) {
  return content_key_of(analysis, version());
}

}  // namespace scene_analyzer::analysis_file
