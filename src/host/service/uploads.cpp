#include "service/uploads.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "import/asset_files.h"
#include "import/file_names.h"
#include "import/import.h"
#include "service/refusal.h"

namespace scene_analyzer::service {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "scene-analyzer-uploads-";
constexpr std::uint64_t kLeastFile = 4096;  // what a file costs the disk, however small
constexpr std::chrono::milliseconds kUntilOthersEnd(2000);

// Holds the folder as long as the descriptor is open; -1 where another process does, or there is none.
// Programs that clean temporary folders leave one that is held.
int try_lock(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return -1;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  ::close(descriptor);
  return -1;
}

bool is_our_folder(const fs::path& path) {
  struct stat state {};
  return ::lstat(path.c_str(), &state) == 0 && S_ISDIR(state.st_mode) && state.st_uid == ::geteuid();
}

// Of services that were killed.
void remove_leftovers(const fs::path& parent) {
  std::error_code ignored;  // what cannot be removed only takes room
  std::vector<fs::path> folders;
  for (fs::directory_iterator entry(parent, ignored), end; !ignored && entry != end; entry.increment(ignored))
    if (entry->path().filename().string().starts_with(kPrefix) && is_our_folder(entry->path()))
      folders.push_back(entry->path());
  for (const fs::path& folder : folders) {
    const int lock = try_lock(folder);
    if (lock < 0) continue;
    fs::remove_all(folder, ignored);
    ::close(lock);
  }
}

[[noreturn]] void refuse_full_disk(const std::system_error& error) {
  const bool full = error.code() == std::errc::no_space_on_device ||
                    error.code() == std::error_code(EDQUOT, std::generic_category());
  throw Refusal(full ? Reason::kBusy : Reason::kInternal,
                fmt::format("the upload cannot be kept: {}", files::describe(error.code())),
                full ? std::optional(kUntilOthersEnd) : std::nullopt);
}

}  // namespace

UploadSpace::UploadSpace(const fs::path& parent, std::uint64_t quota_bytes) : quota_bytes_(quota_bytes) {
  remove_leftovers(parent);
  // Another service that starts now may take a folder for left behind before this one has its lock.
  for (int attempts = 3; lock_ < 0 && attempts > 0; --attempts) {
    std::string pattern = (parent / fmt::format("{}XXXXXX", kPrefix)).string();
    const char* made = ::mkdtemp(pattern.data());
    if (made != nullptr) lock_ = try_lock(made);
    folder_ = pattern;
  }
  if (lock_ < 0)
    throw UsageError(
        fmt::format("no folder for uploads can be made in '{}': {}; choose another with --upload-dir",
                    parent.string(), std::generic_category().message(errno)));
}

UploadSpace::~UploadSpace() {
  std::error_code ignored;  // the next service removes what is left
  fs::remove_all(folder_, ignored);
  ::close(lock_);
}

std::uint64_t UploadSpace::used_bytes() const {
  const std::lock_guard lock(mutex_);
  return used_bytes_;
}

fs::path UploadSpace::make_folder() {
  fs::path folder;
  {
    const std::lock_guard lock(mutex_);
    folder = folder_ / std::to_string(++made_);
  }
  if (::mkdir(folder.c_str(), 0700) != 0) throw std::system_error(errno, std::generic_category());
  return folder;
}

bool UploadSpace::take(std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (bytes > quota_bytes_ - used_bytes_) return false;
  used_bytes_ += bytes;
  return true;
}

void UploadSpace::give_back(std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  used_bytes_ -= bytes;
}

Upload::Upload(UploadSpace& space, std::uint64_t most_bytes) : space_(space), most_bytes_(most_bytes) {
  try {
    folder_ = space.make_folder();
  } catch (const std::system_error& error) {
    refuse_full_disk(error);
  }
}

Upload::~Upload() {
  file_.reset();
  std::error_code ignored;  // removed with the whole space at the latest
  fs::remove_all(folder_, ignored);
  space_.give_back(reserved_);
}

std::string Upload::checked_name(std::string_view name) const {
  const auto refuse = [](const std::string& why) -> std::string { throw Refusal(Reason::kInvalid, why); };
  if (name.empty()) return refuse("a file has no name; FileHeader.name is what the asset calls it");
  if (name.size() > kLongestFileName)
    return refuse(
        fmt::format("a file's name has {} bytes; at most {} are allowed", name.size(), kLongestFileName));
  if (name.find('\0') != std::string_view::npos) return refuse("a file's name holds a zero byte");
  const import::Reference reference = import::resolve_reference("/asset", name);
  if (reference.kind != import::Reference::Kind::kInside || reference.path == "." ||
      reference.path.ends_with('/'))
    return refuse(fmt::format("'{}' is no file's name below the asset's folder", name));
  if (names_->empty() && reference.path.find('/') != std::string::npos)
    return refuse(
        fmt::format("'{}': the first file is the asset, whose name has no '/'; the others are named relative "
                    "to its folder",
                    name));
  if (known_.contains(reference.path)) return refuse(fmt::format("'{}' was sent already", name));
  return reference.path;
}

void Upload::begin_file(std::string_view name, std::optional<std::uint64_t> size) {
  end_file();
  if (names_->size() >= kMostFiles)
    throw Refusal(Reason::kTooLarge, fmt::format("the upload has more than {} files", kMostFiles));
  const std::string called = checked_name(name);
  std::string stored = std::to_string(names_->size());
  if (names_->empty()) try {
      stored += import::known_extension_of(called);
      asset_ = folder_ / stored;
    } catch (const InputError& error) {
      throw Refusal(Reason::kInvalid, fmt::format("{}: {}", called, error.what()));
    }
  if (size && *size > most_bytes_ - bytes_) reserve(*size);  // refused before it is sent
  reserve(0);
  try {
    file_.emplace(files::File::create(folder_ / stored, 0600));
  } catch (const std::system_error& error) {
    refuse_full_disk(error);
  }
  names_->push_back(called);
  known_.insert(called);
  announced_ = size;
  written_ = 0;
}

// Of the quota, what the open file needs when it has `bytes` more than now.
void Upload::reserve(std::uint64_t bytes) {
  if (bytes > most_bytes_ - bytes_)
    throw Refusal(
        Reason::kTooLarge,
        fmt::format("the upload has more than the {} bytes that are allowed (--max-upload)", most_bytes_));
  const auto cost = [](std::uint64_t size) { return std::max(size, kLeastFile); };
  const std::uint64_t more = file_ ? cost(written_ + bytes) - cost(written_) : kLeastFile;
  if (!space_.take(more))
    throw Refusal(Reason::kBusy,
                  "the uploads of all requests have used up their space (--upload-space); try again",
                  kUntilOthersEnd);
  reserved_ += more;
}

void Upload::add(std::string_view bytes) {
  if (!file_) throw Refusal(Reason::kInvalid, "data came before the header of its file");
  if (announced_ && bytes.size() > *announced_ - written_)
    throw Refusal(Reason::kInvalid, fmt::format("'{}' has more than the {} bytes that its header announced",
                                                names_->back(), *announced_));
  reserve(bytes.size());
  try {
    file_->write(bytes);
  } catch (const std::system_error& error) {
    refuse_full_disk(error);
  }
  written_ += bytes.size();
  bytes_ += bytes.size();
}

void Upload::end_file() {
  if (!file_) return;
  if (announced_ && written_ != *announced_)
    throw Refusal(Reason::kInvalid,
                  fmt::format("'{}' ended after {} of the {} bytes that its header announced", names_->back(),
                              written_, *announced_));
  try {
    file_->close();
  } catch (const std::system_error& error) {
    refuse_full_disk(error);
  }
  file_.reset();
}

mesh::AssetSource Upload::finish() {
  end_file();
  if (names_->empty())
    throw Refusal(Reason::kInvalid,
                  "no file was sent; send the asset, or name one below the service's --root as path");
  try {
    import::write_file_names(folder_, *names_);
  } catch (const std::system_error& error) {
    refuse_full_disk(error);
  }
  return {asset_, std::shared_ptr<const mesh::FileNames>(names_)};
}

}  // namespace scene_analyzer::service
