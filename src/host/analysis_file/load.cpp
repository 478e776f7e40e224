#include <fcntl.h>
#include <sys/stat.h>

#include <charconv>
#include <system_error>

#include "analysis_file/analysis_file.h"
#include "analysis_file/codec.h"
#include "analysis_file/envelope.h"
#include "base/error.h"
#include "base/version.h"
#include "files/file.h"

namespace scene_analyzer::analysis_file {
namespace {

Unusable because(std::string reason) {
  return {false, std::move(reason)};
}

// The size comes from the file system, never from the file's own claims.
std::variant<std::string, Unusable> read_bytes(const std::filesystem::path& path) {
  try {
    files::File file = files::File::open_regular(path);
    const std::uint64_t size = file.size();
    if (size > kMaxFileBytes)
      return because("is too large for an analysis file: " + std::to_string(size) + " bytes");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    bytes.resize(file.read(bytes));
    return bytes;
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::no_such_file_or_directory || error.code() == std::errc::not_a_directory)
      return Unusable{true, "is absent"};
    return Unusable{false, "cannot be read: " + files::describe(error.code()), true};
  }
}

std::variant<Stored, Unusable> load_stored(const std::filesystem::path& path) {
  auto bytes = read_bytes(path);
  if (auto* unusable = std::get_if<Unusable>(&bytes)) return *unusable;
  auto payload = unseal(std::get<std::string>(bytes));
  if (auto* unusable = std::get_if<Unusable>(&payload)) return *unusable;
  return decode(std::get<std::string_view>(payload));
}

template <typename T>
std::string number(T value) {
  char digits[40];
  return {digits, std::to_chars(digits, digits + sizeof(digits), value).ptr};
}

// Which parameter the stored results were not computed under, or nothing.
template <typename T>
std::optional<std::string> differing(const char* name, T stored, T wanted) {
  if (stored == wanted) return std::nullopt;
  return std::string("was computed with ") + name + " " + number(stored) + " instead of " + number(wanted);
}

std::optional<std::string> parameter_reason(const analysis::AssetAnalysis& analysis,
                                            const analysis::Parameters& wanted) {
  const analysis::Parameters& stored = analysis.parameters;
  if (auto reason = differing("alpha", stored.alpha_degrees, wanted.alpha_degrees)) return reason;
  if (auto reason = differing("dim", stored.dim, wanted.dim)) return reason;
  if (auto reason = differing("weld tolerance", stored.weld_tolerance, wanted.weld_tolerance)) return reason;
  // Changes nothing but the values of one metric. Rotations are stored with every rendering time.
  if (!analysis.computed[analysis::index_of(analysis::Metric::kFourierTransform)]) return std::nullopt;
  return differing("start searches", stored.start_searches, wanted.start_searches);
}

std::string change_of(const analysis::FileFingerprint& stored, const analysis::FileFingerprint& now) {
  const std::string name = "'" + now.path + "'";
  if (stored.found && !now.found) return "is stale: " + name + " is missing or cannot be read now";
  if (!stored.found && now.found) return "is stale: " + name + ", missing before, is there now";
  return "is stale: " + name + " has changed";
}

// Hashes everything the results depend on again. Throws InputError when the asset cannot be read.
std::optional<std::string> file_reason(const analysis::AssetAnalysis& analysis,
                                       const mesh::AssetSource& asset) {
  const std::string name = asset.file_name();
  if (analysis.files.front().path != name)
    return "belongs to another asset ('" + analysis.files.front().path + "')";
  std::vector<mesh::ReferencedFile> references;
  for (std::size_t i = 1; i < analysis.files.size(); ++i)
    references.push_back({analysis.files[i].path, analysis.files[i].found});
  const auto now = fingerprint(asset, references);
  if (now.size() != analysis.files.size()) return "contradicts itself: the same file twice";
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] != analysis.files[i]) return change_of(analysis.files[i], now[i]);
  return std::nullopt;
}

// prune() drops what was used longest ago. A read-only folder cannot remember that, and need not.
void touch(const std::filesystem::path& file) {
  static_cast<void>(::utimensat(AT_FDCWD, file.c_str(), nullptr, AT_SYMLINK_NOFOLLOW));
}

}  // namespace

std::variant<analysis::AssetAnalysis, Unusable> load(const std::filesystem::path& file) {
  auto stored = load_stored(file);
  if (auto* unusable = std::get_if<Unusable>(&stored)) return *unusable;
  return std::move(std::get<Stored>(stored).analysis);
}

std::variant<analysis::AssetAnalysis, Unusable> load_valid(const std::filesystem::path& file,
                                                           const mesh::AssetSource& asset,
                                                           const analysis::Parameters& parameters) {
  auto loaded = load_stored(file);
  if (auto* unusable = std::get_if<Unusable>(&loaded)) return *unusable;
  Stored& stored = std::get<Stored>(loaded);
  if (stored.version != version())
    return because("was computed by version " + stored.version + " of the program, this is " +
                   std::string(version()));
  if (auto reason = parameter_reason(stored.analysis, parameters)) return because(*reason);
  try {
    if (auto reason = file_reason(stored.analysis, asset)) return because(*reason);
  } catch (const InputError& error) {
    return because(std::string("cannot be compared with its asset: ") + error.what());
  }
  touch(file);
  stored.analysis.asset = asset.name;
  stored.analysis.parameters = parameters;
  return std::move(stored.analysis);
}

}  // namespace scene_analyzer::analysis_file
