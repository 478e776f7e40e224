#include "cli/run_state.h"

#include <fmt/format.h>

#include <atomic>

namespace scene_analyzer::cli {
namespace {

std::atomic<std::size_t> all_assets = 0, done_assets = 0, kept_assets = 0;
std::atomic<bool> report_written = false, has_report = true;

}  // namespace

void begin_run(std::size_t assets, RunKind kind) {
  has_report = kind == RunKind::kReport;
  all_assets = assets;
  done_assets = kept_assets = 0;
  report_written = false;
}

void note_asset_done(bool kept) {
  ++done_assets;
  if (kept) ++kept_assets;
}

void note_report_written() {
  report_written = true;
}

std::string describe_run_state() {
  if (all_assets == 0) return {};
  const std::size_t kept = kept_assets;
  const std::string files =
      kept == 0 ? "no analysis is kept"
      : kept == 1
          ? "1 asset is kept in its analysis file, from which the same command goes on"
          : fmt::format("{} assets are kept in their analysis files, from which the same command goes on",
                        kept);
  if (!has_report)
    return fmt::format("after {} of {} assets; {}", done_assets.load(), all_assets.load(), files);
  return fmt::format("after {} of {} {}: the report is {}; {}", done_assets.load(), all_assets.load(),
                     all_assets == 1 ? "asset" : "assets",
                     report_written ? "written, pictures and other files may be missing" : "not written",
                     files);
}

}  // namespace scene_analyzer::cli
