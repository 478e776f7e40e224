#include "library/journal.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <fstream>
#include <functional>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "files/replace.h"
#include "files/temporary_name.h"
#include "library/output_folder.h"

namespace scene_analyzer::library {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRunning = ".running.jsonl", kWhole = ".jsonl";
constexpr auto kSurelyOver = std::chrono::hours(24 * 7);  // a run that has written nothing for so long

std::string shard_name(Shard shard) {
  return fmt::format("shard-{:05}-of-{:05}", shard.index, shard.count);
}

std::string this_host() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  std::string host = name.data();
  std::erase_if(host, [](unsigned char letter) { return std::isalnum(letter) == 0; });
  return host.empty() ? "unknown" : host.substr(0, 64);
}

// "<shard>.<host>.<process>.<random>.running.jsonl"
std::string running_name(const std::string& shard) {
  return fmt::format("{}.{}.{}{}{}", shard, this_host(), ::getpid(), files::temporary_name(), kRunning);
}

// Whether the run that writes `file` has ended. Its name says where it runs; of other machines nothing can be
// told but that it has been silent for long.
bool is_over(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::string here = '.' + this_host() + '.';
  if (const std::size_t host = name.find(here); host != std::string::npos) {
    int process = 0;
    const char* digits = name.data() + host + here.size();
    const auto [end, error] = std::from_chars(digits, name.data() + name.size(), process);
    // Of this very process it is an earlier one's: restarted containers count processes anew.
    if (error == std::errc() && *end == '.')
      return process == ::getpid() || (::kill(process, 0) != 0 && errno == ESRCH);
  }
  std::error_code gone;
  const auto written = fs::last_write_time(file, gone);
  return !gone && fs::file_time_type::clock::now() - written > kSurelyOver;
}

[[noreturn]] void refuse(const fs::path& file, const std::error_code& code) {
  throw UsageError(
      fmt::format("--out: '{}' cannot be written: {}; what was analysed is kept, and the same "
                  "command goes on from there",
                  file.string(), files::describe(code)));
}

void keep_latest(std::map<std::string, Record>& records, Record record) {
  const auto [known, added] = records.try_emplace(record.asset, record);
  if (!added && known->second.finished <= record.finished) known->second = std::move(record);
}

// The number of the first line that makes no sense, 0 where all do; the last one may be cut off. Nothing
// where the file is gone: the run that wrote it has ended meanwhile.
std::optional<std::size_t> read_records(const fs::path& file, std::map<std::string, Record>& records) {
  std::ifstream lines(file, std::ios::binary);
  if (!lines) {
    std::error_code error;
    if (!fs::exists(file, error) && !error) return std::nullopt;
    throw UsageError(fmt::format("{}: cannot be read", file.string()));
  }
  std::size_t damaged = 0;
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (auto record = record_of(line))
      keep_latest(records, *std::move(record));
    else if (!lines.eof() && damaged == 0)
      damaged = number;
  }
  return damaged;
}

std::vector<fs::path> files_of(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().native().ends_with(kWhole)) files.push_back(entry->path());
  if (error) throw UsageError(fmt::format("{}: cannot be searched: {}", folder.string(), error.message()));
  std::ranges::sort(files);
  return files;
}

// Reads the files that are `wanted`. A run's own file goes when all it says is in the shard's, which may have
// been read before: then all are read again.
Journals read_files(const fs::path& folder, const std::function<bool(const std::string& name)>& wanted) {
  for (;;) {
    Journals journals;
    bool is_whole = true;
    for (const fs::path& file : files_of(folder)) {
      if (!wanted(file.filename().string())) continue;
      const auto damaged = read_records(file, journals.records);
      is_whole = is_whole && damaged.has_value();
      if (damaged.value_or(0) > 0)
        journals.warnings.push_back(
            fmt::format("{}: line {} is no record and does not count", file.string(), *damaged));
    }
    if (is_whole) return journals;
  }
}

}  // namespace

Journals read_journals(const fs::path& folder, std::uint32_t shard_count) {
  const std::string cut = fmt::format("-of-{:05}.", shard_count);
  return read_files(journal_folder(folder),
                    [&](const std::string& name) { return name.find(cut) != std::string::npos; });
}

Journal::Journal(const fs::path& folder, Shard shard)
    : folder_(journal_folder(folder)), shard_(shard_name(shard) + '.') {
  file_ = folder_ / (shard_name(shard) + std::string(kWhole));
  running_file_ = folder_ / running_name(shard_name(shard));
  records_ = read_files(folder_, [&](const std::string& name) { return name.starts_with(shard_); }).records;
  try {
    running_.emplace(files::File::create(running_file_));
  } catch (const std::system_error& error) {
    refuse(running_file_, error.code());
  }
}

const Record* Journal::find(const std::string& asset) const {
  const auto found = records_.find(asset);
  return found == records_.end() ? nullptr : &found->second;
}

void Journal::add(Record record) {
  try {
    running_->write(to_line(record) + '\n');
  } catch (const std::system_error& error) {
    refuse(running_file_, error.code());
  }
  records_.insert_or_assign(record.asset, std::move(record));
}

void Journal::finish(std::span<const std::string> assets) {
  const auto mine = [&](const std::string& name) { return name.starts_with(shard_); };
  for (auto& [asset, record] : read_files(folder_, mine).records) keep_latest(records_, std::move(record));
  std::string text;
  for (const std::string& asset : assets)
    if (const Record* record = find(asset)) text += to_line(*record) + '\n';
  try {
    files::replace(file_, text);
    running_->close();
  } catch (const std::system_error& error) {
    refuse(file_, error.code());
  }
  std::error_code ignored;  // what stays is older than what was written, and does not count
  for (const fs::path& file : files_of(folder_)) {
    const std::string name = file.filename().string();
    if (file == running_file_ || (mine(name) && name.ends_with(kRunning) && is_over(file)))
      fs::remove(file, ignored);
  }
}

}  // namespace scene_analyzer::library
