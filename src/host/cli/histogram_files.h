// histogram_files.h — The folder of `analyze --histograms`: a table and a picture per geometry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "analysis/histogram.h"

namespace scene_analyzer::cli {

// "<row>-<name>" with everything but ASCII letters, digits, '.', '_' and '-' replaced by '_', the name
// shortened to 60 characters: a file name on every system.
std::string histogram_stem(std::size_t row, const std::string& name);

class HistogramFiles {
 public:
  // Creates the folder. Throws UsageError when that is not possible.
  explicit HistogramFiles(std::filesystem::path folder);

  // Rows of the report that come before those of the asset to be analysed next.
  void start_asset(std::size_t rows_before);

  // Writes <row>-<mesh>.csv and .svg, the row being the first that shows the geometry. Never throws for a
  // file: problems are collected.
  void write(const analysis::AssetAnalysis& analysis, std::uint32_t geometry,
             const analysis::Histogram& histogram);

  std::vector<std::string> take_warnings();  // tables refused for their size, with the reason
  std::vector<std::string> take_errors();    // files that could not be written

 private:
  std::filesystem::path folder_;
  std::size_t rows_before_ = 0;
  std::vector<std::size_t> first_instance_;  // per geometry of the asset; filled at its first histogram
  std::vector<std::string> warnings_, errors_;
};

}  // namespace scene_analyzer::cli
