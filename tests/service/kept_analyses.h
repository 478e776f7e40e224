// kept_analyses.h — A ContentStore in a temporary folder, and assets that clients send.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis_file/analysis_file.h"
#include "analysis_file/sample.h"
#include "service/content_store.h"
#include "service/sent_files.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::service {

namespace fs = std::filesystem;
using analysis::AssetAnalysis;

using Files = std::vector<std::pair<std::string, std::string>>;  // names and contents, the asset first

// An upload and how to read it.
struct Sent {
  Sent(UploadSpace& space, const Files& files) : upload(std::make_unique<Upload>(space, kPlenty)) {
    for (const auto& [name, bytes] : files) send(*upload, name, bytes);
    asset.emplace(upload->finish());
  }
  std::unique_ptr<Upload> upload;
  std::optional<mesh::AssetSource> asset;
};

class ContentStoreTest : public testing::Test {
 protected:
  ContentStoreTest() { open(); }

  // As a service does that starts.
  void open(std::uint64_t most_bytes = kPlenty) {
    store_.reset();
    store_ = std::make_unique<ContentStore>(folder_.path() / "store", most_bytes);
  }
  Sent sent(const Files& files) { return {uploads_, files}; }

  // Of an asset that refers to these, with some metric and a warning to tell it by.
  static AssetAnalysis analysis_of(const mesh::AssetSource& asset, const std::string& mark,
                                   const std::vector<mesh::ReferencedFile>& references = {}) {
    AssetAnalysis analysis = analysis_file::full_analysis();
    analysis.files = analysis_file::fingerprint(asset, references);
    analysis.warnings = {mark};
    return analysis;
  }
  AssetAnalysis keep(const mesh::AssetSource& asset, const std::string& mark,
                     const std::vector<mesh::ReferencedFile>& references = {}) {
    AssetAnalysis analysis = analysis_of(asset, mark, references);
    store_->keep(asset, analysis);
    return analysis;
  }
  // The mark of what is found, "" for nothing.
  std::string found(const mesh::AssetSource& asset, const analysis::Parameters& parameters) {
    const auto found = store_->find(asset, parameters);
    EXPECT_EQ(found.unusable, "") << "nobody can do anything about it";
    return found.analysis ? found.analysis->warnings.at(0) : "";
  }
  std::string found(const mesh::AssetSource& asset) {
    return found(asset, analysis_file::full_analysis().parameters);
  }
  std::string got(const AssetAnalysis& analysis) {
    const auto loaded = store_->get(analysis_file::content_key(analysis));
    return loaded ? loaded->warnings.at(0) : "";
  }
  // Of an analysis, once it is kept.
  fs::path file_of(const AssetAnalysis& analysis) const {
    const std::string key = analysis_file::content_key(analysis);
    for (const auto& entry : fs::directory_iterator(folder_.path() / "store" / key.substr(0, 2)))
      if (entry.path().filename().string().starts_with(key)) return entry.path();
    return {};
  }

  TemporaryFolder folder_;
  UploadSpace uploads_{folder_.path(), kPlenty};
  std::unique_ptr<ContentStore> store_;
};

}  // namespace scene_analyzer::service
