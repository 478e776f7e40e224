// analysis_store.h — Where analyses are kept from one run to the next.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "analysis/analysis.h"
#include "mesh/asset_source.h"

namespace scene_analyzer::pipeline {

// Several threads may call it at the same time.
class AnalysisStore {
 public:
  virtual ~AnalysisStore() = default;

  struct Found {
    std::optional<analysis::AssetAnalysis> analysis;
    std::string unusable;  // what is there and why it does not serve, "the analysis file a.analysis is ..."
  };
  // The analysis of the asset as its files are now, by this version of the program, under `parameters`; which
  // metrics it holds is the caller's concern.
  virtual Found find(const mesh::AssetSource& asset, const analysis::Parameters& parameters) = 0;

  // Throws analysis_file::CannotStore.
  virtual void keep(const mesh::AssetSource& asset, const analysis::AssetAnalysis& analysis) = 0;

  // Where the analysis of this asset is kept: when one cannot be, those of the same folder cannot either.
  virtual std::filesystem::path folder_of(const mesh::AssetSource& asset) const = 0;
};

// An analysis file beside each asset, or below a folder for all of them (analysis_file::path_for).
class AnalysisFiles final : public AnalysisStore {
 public:
  explicit AnalysisFiles(std::optional<std::filesystem::path> cache_folder)
      : cache_folder_(std::move(cache_folder)) {}
  Found find(const mesh::AssetSource& asset, const analysis::Parameters& parameters) override;
  void keep(const mesh::AssetSource& asset, const analysis::AssetAnalysis& analysis) override;
  std::filesystem::path folder_of(const mesh::AssetSource& asset) const override;

 private:
  const std::optional<std::filesystem::path> cache_folder_;
};

}  // namespace scene_analyzer::pipeline
