// mesh_files.h — The folders of `analyze --histograms` and `--signals`: tables and pictures per geometry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/analysis.h"
#include "analysis/histogram.h"
#include "analysis/signal.h"

namespace scene_analyzer::cli {

// "<row>-<name>" with everything but ASCII letters, digits, '.', '_' and '-' replaced by '_', the name
// shortened to 60 characters: a file name on every system, and another one for every row.
std::string mesh_stem(std::size_t row, const std::string& name);

// Creates the folder that `option` names, where it is missing. Throws UsageError.
void make_folder(const char* option, const std::filesystem::path& folder);

// A folder, and where in it the files of a geometry belong: under the first row of the report that shows it.
class MeshFiles {
 public:
  // Creates the folder. Throws UsageError, naming `option`, when that is not possible.
  MeshFiles(std::filesystem::path folder, const char* option);

  // Rows of the report that come before those of the asset to be analysed next.
  void start_asset(std::size_t rows_before);

  struct Place {
    const analysis::InstanceAnalysis& instance;  // the geometry's first
    std::size_t row = 0;
    const std::string& name;
    std::string stem;  // path of the geometry's files, without what tells them apart
  };
  Place place_of(const analysis::AssetAnalysis& analysis, std::uint32_t geometry);

  void warn(std::string warning) { warnings_.push_back(std::move(warning)); }
  // Runs `write`; an InputError becomes an entry of take_errors().
  void attempt(const std::function<void()>& write);

  std::vector<std::string> take_warnings();
  std::vector<std::string> take_errors();  // files that could not be written

 private:
  std::filesystem::path folder_;
  std::size_t rows_before_ = 0;
  std::vector<std::size_t> first_instance_;  // per geometry of the asset; filled when it is first needed
  std::vector<std::string> warnings_, errors_;
};

// <row>-<mesh>.csv and .svg. A histogram that was refused for its size gets no table, but a warning. Neither
// this nor the next throws for a file: problems are collected.
void write_histogram(MeshFiles& files, const analysis::AssetAnalysis& analysis, std::uint32_t geometry,
                     const analysis::Histogram& histogram);

// <row>-<mesh>-signal.csv, -spectrum.csv and -signal.svg.
void write_signal(MeshFiles& files, const analysis::AssetAnalysis& analysis, std::uint32_t geometry,
                  const analysis::SignalSpectrum& signal);

}  // namespace scene_analyzer::cli
