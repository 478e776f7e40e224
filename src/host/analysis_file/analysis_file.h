// analysis_file.h — Analysis files: where they lie, how they are written, when they can be trusted.
//
// Bytes: magic "SCNANLZ\n" | u32 format version | u32 reserved 0 | u64 payload size | payload (protobuf
// scene_analyzer.v1.Analysis) | u64 low, u64 high of XXH3-128 over everything before. Little endian.
//
// A file is written to a temporary name beside its place, synced and renamed: it is whole or absent, also
// after SIGKILL or on a full disk. Reading never throws on bad contents: it says why the file cannot be used.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "analysis/analysis.h"
#include "base/error.h"
#include "mesh/asset_source.h"

namespace scene_analyzer::analysis_file {

// `<asset file name with extension>.analysis` beside the asset; or, with a cache folder, below it under the
// asset's absolute path (so two assets never share a file).
std::filesystem::path path_for(const std::filesystem::path& asset,
                               const std::optional<std::filesystem::path>& cache_folder);

// Fingerprints of the asset (first) and of `referenced` paths relative to the asset's folder. Unreadable or
// missing files give found = false, and so does what is no regular file. A path that leads out of the asset's
// folder is opened only if `referenced` says that the import found it. The asset's own name and repeated
// paths count once. Throws InputError when the asset itself cannot be read. Cost: one pass over the bytes,
// constant memory.
std::vector<analysis::FileFingerprint> fingerprint(const mesh::AssetSource& asset,
                                                   const std::vector<mesh::ReferencedFile>& referenced);

// The content key: XXH3-128 over fingerprints, the parameters that change results, and the program version;
// 32 hex digits.
std::string content_key(const analysis::AssetAnalysis& analysis);

// Why a file was not used, one sentence without the path ("is truncated: ...", "was written by a newer
// version ..."). `absent` is the one silent case.
struct Unusable {
  bool absent = false;
  std::string reason;
  bool may_pass = false;  // the system could not read it now; what it holds may be all right
};

std::variant<analysis::AssetAnalysis, Unusable> load(const std::filesystem::path& file);

// load(), and then checks that the file still describes `asset` as it lies on disk now (every referenced file
// is hashed again) under `parameters`, computed by this program version. The metrics it holds are the
// caller's concern, and so are the conditions of rendering times. The result carries `asset` and
// `parameters` as given here; the file's time of modification becomes now, for prune().
std::variant<analysis::AssetAnalysis, Unusable> load_valid(const std::filesystem::path& file,
                                                           const mesh::AssetSource& asset,
                                                           const analysis::Parameters& parameters);

class CannotStore : public InputError {
 public:
  CannotStore(const std::string& what, bool is_the_assets)
      : InputError(what), is_the_assets_(is_the_assets) {}
  // Whether others can be stored: it is this one's size, values or name.
  bool is_the_assets() const { return is_the_assets_; }

 private:
  bool is_the_assets_;
};

// The same analysis gives the same bytes. Creates missing folders of the cache. Throws CannotStore with the
// system's reason when it cannot be written (read-only folder, full disk) or when `analysis` has values that
// no analysis can have; nothing is left behind then.
void store(const std::filesystem::path& file, const analysis::AssetAnalysis& analysis);

struct PruneResult {
  std::uint64_t files_removed = 0, bytes_removed = 0, files_kept = 0, bytes_kept = 0;
};
// Removes `*.analysis` files below `folder` that are older than `max_age_days`, then the least recently used
// ones until at most `max_bytes` remain; also leftovers of interrupted writes older than an hour. Other files
// are not touched. Links are neither followed nor removed. Throws InputError when `folder`
// cannot be searched or, after everything else is done, when a file could not be removed.
PruneResult prune(const std::filesystem::path& folder, std::optional<double> max_age_days,
                  std::optional<std::uint64_t> max_bytes);

}  // namespace scene_analyzer::analysis_file
