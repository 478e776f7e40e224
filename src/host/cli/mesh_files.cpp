#include "cli/mesh_files.h"

#include <fmt/format.h>

#include <utility>

#include "base/error.h"
#include "report/histogram.h"
#include "report/report.h"
#include "report/signal.h"

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

std::string mesh_stem(std::size_t row, const std::string& name) {
  std::string stem = fmt::format("{}-{}", row, std::string_view(name).substr(0, kLongestName));
  for (char& c : stem)
    if (!is_safe(c)) c = '_';
  return stem;
}

void make_folder(const char* option, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw UsageError(
        fmt::format("--{}: the folder '{}' cannot be created: {}", option, folder.string(), error.message()));
}

MeshFiles::MeshFiles(std::filesystem::path folder, const char* option) : folder_(std::move(folder)) {
  make_folder(option, folder_);
}

void MeshFiles::start_asset(std::size_t rows_before) {
  rows_before_ = rows_before;
  first_instance_.clear();
}

MeshFiles::Place MeshFiles::place_of(const analysis::AssetAnalysis& analysis, std::uint32_t geometry) {
  if (first_instance_.empty()) first_instance_ = first_instances(analysis);
  const std::size_t index = first_instance_[geometry];
  const analysis::InstanceAnalysis& instance = analysis.instances[index];
  const std::string& name = instance.mesh.empty() ? instance.node : instance.mesh;
  const std::size_t row = rows_before_ + index;
  return {instance, row, name, (folder_ / mesh_stem(row, name)).string()};
}

void MeshFiles::attempt(const std::function<void()>& write) {
  try {
    write();
  } catch (const InputError& error) {
    errors_.emplace_back(error.what());
  }
}

std::vector<std::string> MeshFiles::take_warnings() {
  return std::exchange(warnings_, {});
}

std::vector<std::string> MeshFiles::take_errors() {
  return std::exchange(errors_, {});
}

void write_histogram(MeshFiles& files, const analysis::AssetAnalysis& analysis, std::uint32_t geometry,
                     const analysis::Histogram& histogram) {
  const MeshFiles::Place place = files.place_of(analysis, geometry);
  const double scale = place.instance.area_scale;
  if (!histogram.refused.empty()) {
    files.warn(fmt::format("{}: the histogram of row {} ({}) is not written as a table: {}", analysis.asset,
                           place.row, place.name, histogram.refused));
    std::error_code ignored;                                // most often there is none
    std::filesystem::remove(place.stem + ".csv", ignored);  // an earlier run's would be taken for this one
  }
  files.attempt([&] {
    if (histogram.refused.empty())
      report::write_file(place.stem + ".csv", report::histogram_csv(histogram, scale));
    if (!histogram.bins.empty())
      report::write_file(place.stem + ".svg", report::histogram_svg(histogram, scale, place.name));
  });
}

void write_signal(MeshFiles& files, const analysis::AssetAnalysis& analysis, std::uint32_t geometry,
                  const analysis::SignalSpectrum& signal) {
  const MeshFiles::Place place = files.place_of(analysis, geometry);
  const double scale = place.instance.area_scale;
  files.attempt([&] {
    report::write_file(place.stem + "-signal.csv", report::signal_csv(signal.areas, scale));
    report::write_file(place.stem + "-spectrum.csv", report::spectrum_csv(signal.magnitudes, scale));
    report::write_file(place.stem + "-signal.svg",
                       report::signal_svg(signal, analysis.geometries[geometry], scale, place.name));
  });
}

}  // namespace scene_analyzer::cli
