#include "library/journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
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

std::string shard_name(Shard shard) {
  return fmt::format("shard-{:05}-of-{:05}", shard.index, shard.count);
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

// Returns the number of the first line that makes no sense; 0 where all do. The last one may be cut off.
std::size_t read_records(const fs::path& file, std::map<std::string, Record>& records) {
  std::ifstream lines(file, std::ios::binary);
  if (!lines) throw UsageError(fmt::format("{}: cannot be read", file.string()));
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

}  // namespace

Journals read_journals(const fs::path& folder) {
  Journals journals;
  for (const fs::path& file : files_of(journal_folder(folder)))
    if (const std::size_t line = read_records(file, journals.records); line > 0)
      journals.warnings.push_back(
          fmt::format("{}: line {} is no record and does not count", file.string(), line));
  return journals;
}

Journal::Journal(const fs::path& folder, Shard shard) : folder_(journal_folder(folder)) {
  const std::string name = shard_name(shard);
  file_ = folder_ / (name + std::string(kWhole));
  running_file_ = folder_ / (name + files::temporary_name() + std::string(kRunning));
  for (const fs::path& file : files_of(folder_)) {
    if (!file.filename().native().starts_with(name + ".")) continue;
    read_records(file, records_);
    if (file.native().ends_with(kRunning)) leftovers_.push_back(file);
  }
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
  leftovers_.push_back(running_file_);
  for (const fs::path& leftover : leftovers_) fs::remove(leftover, ignored);
}

}  // namespace scene_analyzer::library
