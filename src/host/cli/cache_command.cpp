#include "cli/cache_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "analysis_file/analysis_file.h"
#include "base/error.h"
#include "cli/command_line.h"
#include "cli/exit_code.h"
#include "cli/logging.h"
#include "cli/option_parsing.h"

namespace scene_analyzer::cli {
namespace {

constexpr double kDefaultAgeDays = 90;
constexpr std::uint64_t kDefaultBytes = std::uint64_t{1} << 30;

constexpr const char* kExamples =
    "Without --max-age and --max-size both defaults apply; with one of them only that one does.\n"
    "\n"
    "Examples:\n"
    "  scene-analyzer cache --prune --cache-dir ~/analyses\n"
    "  scene-analyzer cache --prune --cache-dir ~/analyses --max-age 7\n"
    "  scene-analyzer cache --prune --cache-dir ~/analyses --max-size 500M\n";

Options make_options() {
  Options options("scene-analyzer cache",
                  "Removes old analysis files below a folder, and then those not used for longest until the "
                  "rest is\nsmall enough. Only *.analysis files and leftovers of interrupted writes are "
                  "touched; what is removed is computed\nagain when it is needed.\n");
  options.usage("--prune --cache-dir DIR [OPTION...]");
  options.add("Pruning",
              {
                  {"prune", "do it"},
                  {"cache-dir", "the folder that 'analyze --cache-dir' was given", "DIR"},
                  {"max-age", "remove files older than this, days, default 90", "DAYS"},
                  {"max-size", "keep at most this much, bytes or with K, M, G, T; default 1G", "SIZE"},
              });
  add_common_options(options);
  return options;
}

std::filesystem::path folder_of(const CommandLine& line) {
  const auto folder = line.value("cache-dir");
  if (!folder || folder->empty())
    throw UsageError("cache --prune needs --cache-dir DIR, the folder to prune");
  std::error_code error;
  if (!std::filesystem::is_directory(*folder, error))
    throw InputError(fmt::format("{}: is no folder", *folder));
  return *folder;
}

}  // namespace

int cache_command(std::span<const std::string> arguments) {
  Options options = make_options();
  const CommandLine line(options, arguments);
  if (line.flag("help")) {
    fmt::print("{}\n{}\n{}", options.help({"Pruning", "Messages"}), kExamples, kExitCodeHelp);
    return kSuccess;
  }
  const LogLevel level = log_level(line.flag("quiet"), line.flag("verbose"));
  set_up_logging(level);
  if (!line.positional().empty())
    throw UsageError(
        fmt::format("'{}' is not understood; the folder is named with --cache-dir", line.positional()[0]));
  if (!line.flag("prune"))
    throw UsageError("cache: say what to do, --prune is all there is; see cache --help");

  std::optional<double> max_age;
  std::optional<std::uint64_t> max_bytes;
  if (const auto age = line.value("max-age")) max_age = parse_number("max-age", *age, 0, 36500, "days");
  if (const auto size = line.value("max-size")) max_bytes = parse_size("max-size", *size);
  if (!max_age && !max_bytes) {
    max_age = kDefaultAgeDays;
    max_bytes = kDefaultBytes;
  }
  const auto result = analysis_file::prune(folder_of(line), max_age, max_bytes);
  if (level != LogLevel::kQuiet)
    fmt::print("removed {} files ({} bytes), kept {} files ({} bytes)\n", result.files_removed,
               result.bytes_removed, result.files_kept, result.bytes_kept);
  return kSuccess;
}

}  // namespace scene_analyzer::cli
