#include "cli/batch_command.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

#include "base/version.h"
#include "cli/batch_options.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/lazy_device.h"
#include "cli/library_progress.h"
#include "cli/logging.h"
#include "cli/run_state.h"
#include "import/import.h"
#include "library/journal.h"
#include "library/output_folder.h"
#include "library/profile.h"

namespace scene_analyzer::cli {
namespace {

std::optional<std::string> environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

library::Manifest make_manifest(const BatchRequest& request) {
  library::Manifest manifest;
  manifest.tool_version = version();
  manifest.parameters = request.pipeline.parameters;
  manifest.metrics = request.pipeline.metrics;
  manifest.timing_width = request.pipeline.timing_width;
  manifest.timing_height = request.pipeline.timing_height;
  manifest.shard_count = request.shard.count;
  library::AssetList list = library::list_assets(request.inputs, request.filter, std::cin);
  if (list.repeated > 0)
    log_warning(fmt::format(
        "{} more names lead to assets of the library, as links or in another spelling; each asset "
        "counts once",
        list.repeated));
  manifest.assets = std::move(list.assets);
  manifest.shards = library::assign_shards(manifest.assets, request.shard.count);
  return manifest;
}

std::vector<std::string> assets_of(const library::Manifest& manifest, std::uint32_t shard) {
  std::vector<std::string> assets;
  for (std::size_t i = 0; i < manifest.assets.size(); ++i)
    if (manifest.shards[i] == shard) assets.push_back(manifest.assets[i].path);
  return assets;
}

void log_record(const library::Record& record, bool unchanged) {
  if (record.status == library::Status::kAnalysed)
    return log_detail(unchanged ? fmt::format("{}: unchanged", record.asset)
                                : fmt::format("{}: analysed in {:.3f} s", record.asset, record.seconds));
  // Reasons of assets that failed begin with their names.
  log_error(record.status == library::Status::kFailed ? record.reason
                                                      : fmt::format("{}: {}", record.asset, record.reason));
}

// "2000 assets: 1993 analysed (1500 of them unchanged), 4 beyond a limit, 3 failed; 53 s, 2249/min"
std::string verdict(const library::ProfileResult& result, std::size_t assets, double seconds) {
  std::string text =
      fmt::format("{} {}: {} analysed", assets, assets == 1 ? "asset" : "assets", result.analysed);
  if (result.unchanged > 0) text += fmt::format(" ({} of them unchanged)", result.unchanged);
  if (result.incomplete > 0) text += fmt::format(", {} beyond a limit", result.incomplete);
  if (result.failed > 0) text += fmt::format(", {} failed", result.failed);
  text += fmt::format("; {}", duration_text(seconds));
  if (seconds > 0) text += fmt::format(", {:.0f}/min", static_cast<double>(assets) / seconds * 60);
  return text;
}

library::ProfileResult run(const BatchRequest& request, const std::vector<std::string>& assets,
                           library::Journal& journal, LazyDevice& device) {
  LibraryProgress progress(request.log != LogLevel::kQuiet, assets.size());
  bool asked = false;
  library::ProfileEvents events;
  events.finished = [&](const library::Record& record, bool unchanged) {
    const bool analysed = record.status == library::Status::kAnalysed;
    progress.aside([&] { log_record(record, unchanged); });
    progress.finish_asset(std::filesystem::path(record.asset).filename().string(), analysed);
    note_asset_done(analysed);
  };
  events.check = check_interrupt;
  events.device = [&]() -> gpu::Device& {
    if (asked) device.forget();  // it was lost
    asked = true;
    return device.get();
  };
  const library::ProfileOptions options{
      .pipeline = request.pipeline, .folder = request.out, .jobs = request.jobs};
  return library::profile(assets, options, journal, events);
}

}  // namespace

int batch_command(std::span<const std::string> arguments) {
  BatchRequest request = parse_batch(arguments, environment);
  if (request.help) {
    fmt::print("{}", batch_help());
    return kSuccess;
  }
  set_up_logging(request.log);
  watch_interrupts();
  request.pipeline.import_limits.stop = interrupt_token();
  for (const std::string& missing : import::missing_isolation()) log_detail(missing);
  const auto begin = std::chrono::steady_clock::now();
  const library::Manifest manifest = make_manifest(request);
  if (manifest.assets.empty()) log_warning("the library holds no assets; see --include in --help");
  library::prepare_folder(request.out);
  library::write_manifest(request.out, manifest);
  const std::vector<std::string> assets = assets_of(manifest, request.shard.index);
  begin_run(assets.size(), RunKind::kLibrary);
  LazyDevice device(device_options(request.device));
  library::Journal journal(request.out, request.shard);
  const library::ProfileResult result = run(request, assets, journal, device);
  const auto validation = device.take_validation_messages();
  for (const std::string& message : validation) log_error(message);
  journal.finish(assets);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  if (request.log != LogLevel::kQuiet) fmt::print("{}\n", verdict(result, assets.size(), seconds.count()));
  if (!validation.empty()) return kUnusable;
  return result.incomplete + result.failed > 0 ? kInputFailed : kSuccess;
}

}  // namespace scene_analyzer::cli
