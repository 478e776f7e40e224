#include "pipeline/analysis_store.h"

#include <fmt/format.h>

#include <utility>
#include <variant>

#include "analysis_file/analysis_file.h"

namespace scene_analyzer::pipeline {

namespace fs = std::filesystem;

AnalysisStore::Found AnalysisFiles::find(const mesh::AssetSource& asset,
                                         const analysis::Parameters& parameters) {
  const fs::path file = analysis_file::path_for(asset.file, cache_folder_);
  auto loaded = analysis_file::load_valid(file, asset, parameters);
  if (const auto* unusable = std::get_if<analysis_file::Unusable>(&loaded))
    return {{},
            unusable->absent ? "" : fmt::format("the analysis file {} {}", file.string(), unusable->reason)};
  return {std::move(std::get<analysis::AssetAnalysis>(loaded)), {}};
}

void AnalysisFiles::keep(const mesh::AssetSource& asset, const analysis::AssetAnalysis& analysis) {
  analysis_file::store(analysis_file::path_for(asset.file, cache_folder_), analysis);
}

fs::path AnalysisFiles::folder_of(const mesh::AssetSource& asset) const {
  return cache_folder_ ? *cache_folder_ : analysis_file::path_for(asset.file, {}).parent_path();
}

}  // namespace scene_analyzer::pipeline
