#include "cli/merge_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <optional>
#include <vector>

#include "base/error.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/library_progress.h"
#include "cli/logging.h"
#include "cli/merge_options.h"
#include "cli/outputs.h"
#include "cli/terminal.h"
#include "library/merge.h"
#include "report/report.h"

namespace scene_analyzer::cli {
namespace {

std::optional<library::Merged> merge(const MergeRequest& request) {
  std::vector<std::string> warnings;
  try {
    MergeStatus status(request.log != LogLevel::kQuiet);
    library::Merged merged = library::merge(request.folder, request.merge, warnings,
                                            [&](std::uint64_t done, std::uint64_t assets) {
                                              check_interrupt();
                                              status.update(done, assets);
                                            });
    for (const std::string& warning : warnings) log_warning(warning);
    return merged;
  } catch (const library::Incomplete& error) {
    for (const std::string& line : error.lines()) log_error(line);
    log_error(error.what());
    return std::nullopt;
  }
}

bool write_outputs(const MergeRequest& request, const library::Merged& merged) {
  Outputs outputs;
  library::Offenders offenders;
  bool are_named = false;
  if (request.json || request.table())
    outputs.attempt([&] {
      offenders = library::top_offenders(request.folder, merged, request.top, check_interrupt);
      are_named = true;
    });
  if (request.json && are_named)
    outputs.attempt(
        [&] { report::write_file(*request.json, library::summary_json(merged, offenders, request.top)); });
  if (request.csv)
    outputs.attempt([&] {
      report::write_file(*request.csv, [&](const report::Sink& sink) {
        library::write_csv(request.folder, merged, [&](std::string_view bytes) {
          check_interrupt();
          sink(bytes);
        });
      });
    });
  if (request.table() && are_named)
    outputs.attempt([&] {
      const report::TableStyle style{.color = false, .width = terminal_width(STDOUT_FILENO), .max_rows = 0};
      report::write_file("-", library::summary_table(merged, offenders, request.top, style));
    });
  return outputs.are_good();
}

}  // namespace

int merge_command(std::span<const std::string> arguments) {
  const MergeRequest request = parse_merge(arguments);
  if (request.help) {
    fmt::print("{}", merge_help());
    return kSuccess;
  }
  set_up_logging(request.log);
  watch_interrupts();
  const std::optional<library::Merged> merged = merge(request);
  if (!merged) return kGateFailed;
  if (merged->mixed_timings)
    log_warning(
        "rendering times were measured on different kinds of devices, which cannot be rated together; R_rt "
        "stays empty. With batch --device all are measured on that device");
  if (!merged->missing.empty()) log_warning(fmt::format("{} assets are missing", merged->missing.size()));
  const bool written = write_outputs(request, *merged);
  return written && merged->not_analysed.empty() ? kSuccess : kInputFailed;
}

}  // namespace scene_analyzer::cli
