// content_store.h — Analyses by what they are analyses of: the same files give the same answer, whoever sends
// them, under whatever path.
//
//   FOLDER/<two digits>/<content key>-<asset key>.analysis
//
// The content key (analysis_file::content_key) covers every file that the results depend on, which is known
// after the import alone. The asset key covers what is known before: name and contents of the asset's own
// file, parameters and program version. An asset key leads to at most eight analyses, the newest, and of
// these one is taken whose other files are the same.
//
// What was used longest ago goes first when the folder is full. Cost: an index of some 200 bytes per analysis
// in memory; finding and storing do not depend on how many there are.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "pipeline/analysis_store.h"

namespace scene_analyzer::service {

class ContentStore final : public pipeline::AnalysisStore {
 public:
  // Creates the folder; reads the names in it. One service at a time: throws UsageError when another has it,
  // and with the system's reason when it cannot be used.
  // `log_error` is told when an analysis cannot be stored; whose it is learns only that.
  ContentStore(
      const std::filesystem::path& folder, std::uint64_t most_bytes,
      std::function<void(const std::string&)> log_error = [](const std::string&) {});
  ~ContentStore() override;
  ContentStore(const ContentStore&) = delete;
  ContentStore& operator=(const ContentStore&) = delete;

  Found find(const mesh::AssetSource& asset, const analysis::Parameters& parameters) override;
  void keep(const mesh::AssetSource& asset, const analysis::AssetAnalysis& analysis) override;
  std::filesystem::path folder_of(const mesh::AssetSource& asset) const override;

  // The analysis of that content key.
  std::optional<analysis::AssetAnalysis> get(const std::string& content_key);

  std::uint64_t size() const;   // analyses
  std::uint64_t bytes() const;  // of their files

 private:
  struct Entry {
    std::string content_key, asset_key;
    std::uint64_t bytes = 0;
  };
  using Entries = std::list<Entry>;  // the one used last first

  void read_folder();
  std::filesystem::path path_of(const Entry& entry) const;
  // With the mutex held.
  void insert(Entry entry);
  void make_findable(const Entry& entry);  // by its asset
  void forget(const std::string& content_key);
  void make_room();
  // Of these analyses, files that may be gone by the time they are read.
  std::vector<Entry> entries_of_asset(const std::string& asset_key) const;
  std::optional<Entry> entry_of(const std::string& content_key) const;
  void note_use(const std::string& content_key);

  const std::filesystem::path folder_;
  const std::uint64_t most_bytes_;
  const std::function<void(const std::string&)> log_error_;
  int lock_ = -1;
  mutable std::mutex mutex_;
  Entries entries_;
  std::unordered_map<std::string, Entries::iterator> by_content_;
  std::unordered_map<std::string, std::deque<std::string>> by_asset_;  // content keys, the newest first
  std::uint64_t bytes_ = 0;
};

}  // namespace scene_analyzer::service
