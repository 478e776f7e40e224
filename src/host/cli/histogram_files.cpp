#include "cli/histogram_files.h"

#include <fmt/format.h>

#include <utility>

#include "base/error.h"
#include "report/histogram.h"
#include "report/report.h"

namespace scene_analyzer::cli {
namespace {

constexpr std::size_t kLongestName = 60;

bool is_safe(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
         c == '-';
}

std::vector<std::size_t> first_instances(const analysis::AssetAnalysis& analysis) {
  std::vector<std::size_t> first(analysis.geometries.size());
  for (std::size_t i = analysis.instances.size(); i-- > 0;) first[analysis.instances[i].geometry] = i;
  return first;
}

}  // namespace

std::string histogram_stem(std::size_t row, const std::string& name) {
  std::string stem = fmt::format("{}-{}", row, std::string_view(name).substr(0, kLongestName));
  for (char& c : stem)
    if (!is_safe(c)) c = '_';
  return stem;
}

HistogramFiles::HistogramFiles(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error)
    throw UsageError(fmt::format("--histograms: the folder '{}' cannot be created: {}", folder_.string(),
                                 error.message()));
}

void HistogramFiles::start_asset(std::size_t rows_before) {
  rows_before_ = rows_before;
  first_instance_.clear();
}

void HistogramFiles::write(const analysis::AssetAnalysis& analysis, std::uint32_t geometry,
                           const analysis::Histogram& histogram) {
  if (first_instance_.empty()) first_instance_ = first_instances(analysis);
  const std::size_t instance_index = first_instance_[geometry];
  const analysis::InstanceAnalysis& instance = analysis.instances[instance_index];
  const std::string& name = instance.mesh.empty() ? instance.node : instance.mesh;
  const std::size_t row = rows_before_ + instance_index;
  const std::filesystem::path stem = folder_ / histogram_stem(row, name);
  if (!histogram.refused.empty()) {
    warnings_.push_back(fmt::format("{}: the histogram of row {} ({}) is not written as a table: {}",
                                    analysis.asset, row, name, histogram.refused));
    std::error_code ignored;                                   // most often there is none
    std::filesystem::remove(stem.string() + ".csv", ignored);  // an earlier run's would be taken for this one
  }
  try {
    if (histogram.refused.empty())
      report::write_file(stem.string() + ".csv", report::histogram_csv(histogram, instance.area_scale));
    if (!histogram.bins.empty())
      report::write_file(stem.string() + ".svg", report::histogram_svg(histogram, instance.area_scale, name));
  } catch (const InputError& error) {
    errors_.emplace_back(error.what());
  }
}

std::vector<std::string> HistogramFiles::take_warnings() {
  return std::exchange(warnings_, {});
}

std::vector<std::string> HistogramFiles::take_errors() {
  return std::exchange(errors_, {});
}

}  // namespace scene_analyzer::cli
