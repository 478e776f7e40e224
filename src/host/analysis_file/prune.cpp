#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <tuple>
#include <vector>

#include "analysis_file/analysis_file.h"
#include "base/error.h"
#include "files/temporary_name.h"

namespace scene_analyzer::analysis_file {
namespace {

namespace fs = std::filesystem;

constexpr double kSecondsPerDay = 86400;
constexpr double kLeftoverSeconds = 3600;

struct Entry {
  fs::path path;
  std::uint64_t bytes = 0;
  fs::file_time_type used;  // stores write it, valid loads touch it
};

struct Found {
  std::vector<Entry> analyses;
  std::vector<Entry> leftovers;
};

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
  throw InputError("cache folder '" + path.string() + "' cannot be searched: " + error.message());
}

// Regular files only: links stay, and the iterator does not enter linked folders.
void add_entry(const fs::directory_entry& item, Found& found) {
  const std::string name = item.path().filename().string();
  const bool leftover = files::is_temporary_name(name);
  if (!leftover && !name.ends_with(".analysis")) return;
  std::error_code error;
  if (item.symlink_status(error).type() != fs::file_type::regular) return;
  Entry entry{item.path(), 0, {}};
  entry.bytes = item.file_size(error);
  if (!error) entry.used = item.last_write_time(error);
  if (error) return;  // gone meanwhile: another process prunes or stores, too
  (leftover ? found.leftovers : found.analyses).push_back(std::move(entry));
}

Found search(const fs::path& folder) {
  std::error_code error;
  fs::recursive_directory_iterator item(folder, fs::directory_options::skip_permission_denied, error);
  if (error) fail(folder, error);
  Found found;
  for (const fs::recursive_directory_iterator end; item != end; item.increment(error)) {
    if (error) fail(folder, error);
    add_entry(*item, found);
  }
  if (error) fail(folder, error);
  return found;
}

class Remover {
 public:
  // False when the file is still there.
  bool remove(const Entry& entry) {
    std::error_code error;
    fs::remove(entry.path, error);  // an absent file is no error: someone else was first
    if (error) {
      if (failures_++ == 0) first_failure_ = "'" + entry.path.string() + "': " + error.message();
      return false;
    }
    ++result.files_removed;
    result.bytes_removed += entry.bytes;
    return true;
  }
  void keep(const Entry& entry) {
    ++result.files_kept;
    result.bytes_kept += entry.bytes;
  }
  void report_failures() const {
    if (failures_ == 0) return;
    const std::string others = failures_ > 1 ? " (and " + std::to_string(failures_ - 1) + " more)" : "";
    throw InputError("analysis file cannot be removed: " + first_failure_ + others);
  }

  PruneResult result;

 private:
  std::uint64_t failures_ = 0;
  std::string first_failure_;
};

double age_seconds(const Entry& entry, fs::file_time_type now) {
  return std::chrono::duration<double>(now - entry.used).count();
}

}  // namespace

PruneResult prune(const fs::path& folder, std::optional<double> max_age_days,
                  std::optional<std::uint64_t> max_bytes) {
  Found found = search(folder);
  const fs::file_time_type now = fs::file_time_type::clock::now();
  Remover remover;
  for (const Entry& leftover : found.leftovers)
    if (age_seconds(leftover, now) > kLeftoverSeconds) remover.remove(leftover);

  // Most recently used first; among equals the path decides, so that runs agree.
  std::sort(found.analyses.begin(), found.analyses.end(), [](const Entry& a, const Entry& b) {
    return std::tie(b.used, a.path) < std::tie(a.used, b.path);
  });
  std::uint64_t budget = max_bytes.value_or(UINT64_MAX);
  bool full = false;
  for (const Entry& entry : found.analyses) {
    const bool old = max_age_days && age_seconds(entry, now) > *max_age_days * kSecondsPerDay;
    full = full || entry.bytes > budget;
    if ((old || full) && remover.remove(entry)) continue;
    remover.keep(entry);
    budget -= std::min(budget, entry.bytes);
  }
  remover.report_failures();
  return remover.result;
}

}  // namespace scene_analyzer::analysis_file
