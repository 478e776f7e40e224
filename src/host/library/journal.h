// journal.h — What became of the assets of a shard, written as it happens: nothing that was said is lost when
// the process is killed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/file.h"
#include "library/record.h"
#include "library/shards.h"

namespace scene_analyzer::library {

// The latest record of each asset, and what could not be read.
struct Journals {
  std::map<std::string, Record> records;  // by asset
  std::vector<std::string> warnings;
};
// Of the shards of a library that is cut into so many; what another cut has left does not count. Lines that
// are cut off, as a killed process leaves them, count as not written. Runs may go on meanwhile. Throws
// UsageError when the folder cannot be searched.
Journals read_journals(const std::filesystem::path& folder, std::uint32_t shard_count);

class Journal {
 public:
  // Finds what earlier runs of the shard have left. Throws UsageError when the journal cannot be read or
  // written.
  Journal(const std::filesystem::path& folder, Shard shard);

  const Record* find(const std::string& asset) const;
  // Written at once; the latest record of an asset counts. Throws UsageError when the disk is full.
  void add(Record record);
  // Replaces the shard's journal by one of `assets`, in their order, with what other runs of the shard have
  // added meanwhile, and removes those of runs that are over. Throws UsageError.
  void finish(std::span<const std::string> assets);

 private:
  std::filesystem::path folder_, file_, running_file_;
  std::string shard_;  // how its files' names begin
  std::map<std::string, Record> records_;
  std::optional<files::File> running_;
};

}  // namespace scene_analyzer::library
