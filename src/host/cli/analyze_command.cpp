#include "cli/analyze_command.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/version.h"
#include "cli/analyze_assets.h"
#include "cli/analyze_options.h"
#include "cli/exit_code.h"
#include "cli/export_file.h"
#include "cli/interrupt.h"
#include "cli/lazy_device.h"
#include "cli/mesh_files.h"
#include "cli/outputs.h"
#include "cli/picture_files.h"
#include "cli/run_state.h"
#include "cli/terminal.h"
#include "import/import.h"
#include "report/report.h"

namespace scene_analyzer::cli {
namespace {

// Assets in metres beside assets in centimetres, or lying on their side, make one scene only by accident.
template <typename Value>
void warn_if_mixed(const std::vector<analysis::AssetAnalysis>& assets,
                   std::optional<Value> analysis::AssetAnalysis::*field, const char* what) {
  const analysis::AssetAnalysis* first = nullptr;
  for (const auto& asset : assets) {
    if (!(asset.*field)) continue;
    if (first == nullptr) first = &asset;
    if (*(asset.*field) == *(first->*field)) continue;
    log_warning(fmt::format("assets of one scene differ in {}: {} has {}, {} has {}; nothing is converted",
                            what, first->asset, *(first->*field), asset.asset, *(asset.*field)));
    return;
  }
}

report::SceneReport make_report(const AnalyzeRequest& request,
                                const std::vector<analysis::AssetAnalysis>& assets) {
  report::SceneReport report;
  report.tool_version = version();
  report.parameters = request.pipeline.parameters;
  report.options = request.ratings;
  report.assets = assets;
  report.rating = ratings::rate(assets, request.ratings);
  // The device that the figures come from, also when they were read from a file: a rerun prints the same.
  const auto measured =
      std::ranges::find_if(assets, [](const auto& asset) { return !asset.device.name.empty(); });
  if (measured != assets.end()) report.device = measured->device;
  return report;
}

void print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw InputError("standard output cannot be written");
}

bool write_outputs(const AnalyzeRequest& request, const report::SceneReport& report) {
  Outputs outputs;
  if (request.json) outputs.attempt([&] { report::write_file(*request.json, report::json(report)); });
  if (request.csv) outputs.attempt([&] { report::write_file(*request.csv, report::csv(report)); });
  if (request.table() && !report.assets.empty()) {
    report::TableStyle style;
    style.color = wants_color(STDOUT_FILENO);
    style.width = terminal_width(STDOUT_FILENO);
    outputs.attempt([&] {
      print(report::table(report, style));
      if (request.defects) print('\n' + report::defect_table(report, style));
    });
  }
  return outputs.are_good();
}

// What the validation layer says, where it is on.
bool device_was_used_well(LazyDevice& device) {
  const auto validation = device.take_validation_messages();
  for (const std::string& message : validation) log_error(message);
  return validation.empty();
}

void warn_if_timings_are_mixed(const report::SceneReport& report) {
  if (!report.rating.mixed_timings || !report.options.metrics[index_of(analysis::Metric::kRenderingTime)])
    return;
  log_warning(
      "the assets' rendering times were measured on different devices, which cannot be rated together; R_rt "
      "stays empty. With --device all are measured on that device");
}

void log_peak_memory() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return;
  log_detail(fmt::format("peak memory of this process {:.1f} MiB, without import workers",
                         static_cast<double>(usage.ru_maxrss) / 1024));
}

}  // namespace

int analyze_command(std::span<const std::string> arguments) {
  AnalyzeRequest request = parse_analyze(arguments);
  if (request.help) {
    print(analyze_help());
    return kSuccess;
  }
  set_up_logging(request.log);
  watch_interrupts();
  request.pipeline.import_limits.stop = interrupt_token();
  for (const std::string& missing : import::missing_isolation()) log_detail(missing);
  if (request.pictures.image_set) make_folder("image-set", *request.pictures.image_set);
  LazyDevice device(device_options(request.device));
  const Analyses analyses = analyze_assets(request, device);
  warn_if_mixed(analyses.assets, &analysis::AssetAnalysis::unit_scale, "their unit in metres");
  warn_if_mixed(analyses.assets, &analysis::AssetAnalysis::up_axis, "their up axis");
  // Wrong use of the device makes every figure doubtful: nothing is written.
  if (!device_was_used_well(device)) return kUnusable;
  const report::SceneReport report = make_report(request, analyses.assets);
  warn_if_timings_are_mixed(report);
  bool written = write_outputs(request, report);
  if (written) note_report_written();
  written = write_export(request, report) && written;
  written = write_pictures(request, report, device) && written;
  log_peak_memory();
  if (!device_was_used_well(device)) return kUnusable;
  return written && analyses.all_good ? kSuccess : kInputFailed;
}

}  // namespace scene_analyzer::cli
