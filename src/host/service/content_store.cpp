#include "service/content_store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include "analysis_file/analysis_file.h"
#include "base/error.h"
#include "files/file.h"
#include "files/temporary_name.h"

namespace scene_analyzer::service {
namespace {

namespace fs = std::filesystem;
using analysis::AssetAnalysis;

constexpr std::size_t kKeyDigits = 32;
constexpr std::size_t kFolderDigits = 2;
constexpr std::string_view kSuffix = ".analysis";
constexpr std::size_t kMostPerAsset = 8;

bool is_hexadecimal(std::string_view text, std::size_t digits) {
  return text.size() == digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool is_key(std::string_view text) {
  return is_hexadecimal(text, kKeyDigits);
}

// The content key of an asset that refers to nothing else.
std::string asset_key_of(const analysis::FileFingerprint& asset, const analysis::Parameters& parameters) {
  AssetAnalysis alone;
  alone.parameters = parameters;
  alone.files = {asset};
  return analysis_file::content_key(alone);
}

int lock_folder(const fs::path& folder) {
  const int descriptor = ::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0)
    throw UsageError(fmt::format("--store: '{}' cannot be written: {}", folder.string(),
                                 std::generic_category().message(errno)));
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  ::close(descriptor);
  throw UsageError(
      fmt::format("--store: another service uses '{}'; each needs a folder of its own", folder.string()));
}

}  // namespace

ContentStore::ContentStore(const fs::path& folder, std::uint64_t most_bytes,
                           std::function<void(const std::string&)> log_error)
    : folder_(folder), most_bytes_(most_bytes), log_error_(std::move(log_error)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    throw UsageError(fmt::format("--store: '{}' cannot be made: {}", folder_.string(), error.message()));
  lock_ = lock_folder(folder_);
  try {
    read_folder();
  } catch (const std::system_error& failure) {
    ::close(lock_);
    throw UsageError(
        fmt::format("--store: '{}' cannot be read: {}", folder_.string(), files::describe(failure.code())));
  }
}

ContentStore::~ContentStore() {
  ::close(lock_);
}

void ContentStore::read_folder() {
  std::vector<std::pair<fs::file_time_type, Entry>> found;
  for (const auto& part : fs::directory_iterator(folder_)) {
    // Others, such as a file system's lost+found, are not ours and perhaps cannot be read.
    if (part.is_symlink() || !is_hexadecimal(part.path().filename().string(), kFolderDigits)) continue;
    if (!part.is_directory()) continue;
    for (const auto& file : fs::directory_iterator(part)) {
      const std::string name = file.path().filename().string();
      std::error_code ignored;  // of a file that was just removed by somebody
      if (files::is_temporary_name(name)) fs::remove(file.path(), ignored);
      const std::string_view keys(name);
      if (name.size() != 2 * kKeyDigits + 1 + kSuffix.size() || !keys.ends_with(kSuffix)) continue;
      Entry entry{name.substr(0, kKeyDigits), name.substr(kKeyDigits + 1, kKeyDigits),
                  file.file_size(ignored)};
      if (!is_key(entry.content_key) || !is_key(entry.asset_key) || path_of(entry) != file.path()) continue;
      found.emplace_back(file.last_write_time(ignored), std::move(entry));
    }
  }
  std::ranges::stable_sort(found, {}, [](const auto& one) { return one.first; });
  const std::lock_guard lock(mutex_);
  for (auto& [time, entry] : found) insert(std::move(entry));
  make_room();
}

fs::path ContentStore::path_of(const Entry& entry) const {
  return folder_ / entry.content_key.substr(0, kFolderDigits) /
         fmt::format("{}-{}{}", entry.content_key, entry.asset_key, kSuffix);
}

pipeline::AnalysisStore::Found ContentStore::find(const mesh::AssetSource& asset,
                                                  const analysis::Parameters& parameters) {
  std::optional<AssetAnalysis> best;
  std::string content_key;
  try {
    const auto own = analysis_file::fingerprint(asset, {});
    for (const Entry& entry : entries_of_asset(asset_key_of(own.front(), parameters))) {
      auto loaded = analysis_file::load_valid(path_of(entry), asset, parameters);
      auto* analysis = std::get_if<AssetAnalysis>(&loaded);
      if (analysis == nullptr || (best && best->computed.count() >= analysis->computed.count())) continue;
      best = std::move(*analysis);
      content_key = entry.content_key;
    }
  } catch (const InputError&) {
    return {};  // the import says what is wrong with the asset
  }
  if (best) note_use(content_key);
  return {std::move(best), {}};
}

void ContentStore::keep(const mesh::AssetSource&, const AssetAnalysis& analysis) {
  Entry entry{analysis_file::content_key(analysis),
              asset_key_of(analysis.files.front(), analysis.parameters)};
  const fs::path path = path_of(entry);
  try {
    analysis_file::store(path, analysis);
  } catch (const analysis_file::CannotStore& error) {
    log_error_(error.what());
    // Paths of this machine are none of the client's business.
    throw analysis_file::CannotStore("the service cannot store the analysis", true);
  }
  std::error_code ignored;  // whoever removed it meanwhile has made room
  entry.bytes = fs::file_size(path, ignored);
  if (ignored) return;
  const std::lock_guard lock(mutex_);
  insert(std::move(entry));
  make_room();
}

fs::path ContentStore::folder_of(const mesh::AssetSource&) const {
  return folder_;
}

std::optional<AssetAnalysis> ContentStore::get(const std::string& content_key) {
  const std::optional<Entry> entry = entry_of(content_key);
  if (!entry) return std::nullopt;
  const fs::path path = path_of(*entry);
  auto loaded = analysis_file::load(path);
  if (auto* analysis = std::get_if<AssetAnalysis>(&loaded)) {
    note_use(content_key);
    std::error_code ignored;  // of a file that has just gone; else the next service knows of its use, as of
                              // what load_valid() has read
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
    return std::move(*analysis);
  }
  if (std::get<analysis_file::Unusable>(loaded).may_pass) return std::nullopt;
  const std::lock_guard lock(mutex_);
  forget(content_key);
  return std::nullopt;
}

std::uint64_t ContentStore::size() const {
  const std::lock_guard lock(mutex_);
  return entries_.size();
}

std::uint64_t ContentStore::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

std::vector<ContentStore::Entry> ContentStore::entries_of_asset(const std::string& asset_key) const {
  const std::lock_guard lock(mutex_);
  std::vector<Entry> entries;
  const auto keys = by_asset_.find(asset_key);
  if (keys == by_asset_.end()) return entries;
  for (const std::string& key : keys->second) entries.push_back(*by_content_.at(key));
  return entries;
}

std::optional<ContentStore::Entry> ContentStore::entry_of(const std::string& content_key) const {
  const std::lock_guard lock(mutex_);
  const auto found = by_content_.find(content_key);
  return found == by_content_.end() ? std::nullopt : std::optional(*found->second);
}

void ContentStore::note_use(const std::string& content_key) {
  const std::lock_guard lock(mutex_);
  const auto found = by_content_.find(content_key);
  if (found != by_content_.end()) entries_.splice(entries_.begin(), entries_, found->second);
}

void ContentStore::insert(Entry entry) {
  const auto known = by_content_.find(entry.content_key);
  if (known != by_content_.end()) {
    bytes_ += entry.bytes - known->second->bytes;
    known->second->bytes = entry.bytes;
    entries_.splice(entries_.begin(), entries_, known->second);
    make_findable(entry);
    return;
  }
  bytes_ += entry.bytes;
  make_findable(entry);
  entries_.push_front(std::move(entry));
  by_content_.emplace(entries_.front().content_key, entries_.begin());
}

void ContentStore::make_findable(const Entry& entry) {
  std::deque<std::string>& of_asset = by_asset_[entry.asset_key];
  std::erase(of_asset, entry.content_key);
  of_asset.push_front(entry.content_key);
  if (of_asset.size() > kMostPerAsset) of_asset.pop_back();  // still found by its content key
}

void ContentStore::forget(const std::string& content_key) {
  const auto found = by_content_.find(content_key);
  if (found == by_content_.end()) return;
  const Entries::iterator entry = found->second;
  const auto of_asset = by_asset_.find(entry->asset_key);
  if (of_asset != by_asset_.end()) {  // the newest of that asset may all be gone already
    std::erase(of_asset->second, content_key);
    if (of_asset->second.empty()) by_asset_.erase(of_asset);
  }
  std::error_code ignored;  // it is not found any more, and the next service sees what is left
  fs::remove(path_of(*entry), ignored);
  bytes_ -= entry->bytes;
  by_content_.erase(found);
  entries_.erase(entry);
}

void ContentStore::make_room() {
  while (bytes_ > most_bytes_ && !entries_.empty()) forget(std::string(entries_.back().content_key));
}

}  // namespace scene_analyzer::service
