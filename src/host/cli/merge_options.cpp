#include "cli/merge_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "cli/command_line.h"
#include "cli/option_parsing.h"
#include "cli/output_options.h"

namespace scene_analyzer::cli {
namespace {

constexpr std::size_t kMostListed = 10'000;

constexpr const char* kPurpose =
    "Rates a library that 'scene-analyzer batch' has analysed as one scene: densities and rendering times "
    "of\n"
    "all meshes against each other. Prints totals, the distribution of every rating, the worst meshes, "
    "shapes\n"
    "that are stored in several assets, and defects. There is no R_d, as nobody stands anywhere.\n";

constexpr const char* kExamples =
    "Examples:\n"
    "  scene-analyzer merge analysed/\n"
    "  scene-analyzer merge analysed/ --csv meshes.csv --json summary.json --top 50\n"
    "  scene-analyzer merge analysed/ --json - | jq '.top.aggregate[].asset'\n";

constexpr const char* kMergeExitCodes =
    "Exit codes:\n"
    "  0  all assets of the library are in the result\n"
    "  1  a shard has not finished, or an asset is missing; nothing was written\n"
    "  2  wrong options, or an error of the program\n"
    "  3  some assets could not be analysed (the others are in the result), or a file could not be written\n";

Options make_options() {
  Options options("scene-analyzer merge", kPurpose);
  options.usage("[OPTION...] DIR");
  options.add(
      "Rating",
      {
          {"weights", "share of each metric in the aggregate, at least 0, those not named 0; default 1 each",
           "KEY=W,..."},
          {"relative",
           "map each metric from its range within the library to its whole range before aggregating"},
          {"allow-missing", "merge what is there, although assets are missing"},
      });
  options.add(
      "Output",
      {
          {"top", "meshes per rating, and shapes, that are listed; default 10", "N"},
          {"json", "write the summary to FILE, or to standard output in its place (-)", "FILE|-"},
          {"csv", "write a line per mesh, with the columns of analyze, to FILE or standard output (-)",
           "FILE|-"},
      });
  add_common_options(options);
  return options;
}

void read_rating(const CommandLine& line, ratings::Options& options) {
  options.relative = line.flag("relative");
  if (const auto weights = line.value("weights")) options.weights = parse_weights("weights", *weights);
}

}  // namespace

MergeRequest parse_merge(std::span<const std::string> arguments) {
  Options options = make_options();
  const CommandLine line(options, arguments);
  MergeRequest request;
  request.help = line.flag("help");
  if (request.help) return request;
  request.log = log_level(line.flag("quiet"), line.flag("verbose"));
  if (line.positional().size() != 1 || line.positional().front().empty())
    throw UsageError(
        "one folder is needed, that of batch --out; for example: scene-analyzer merge analysed/");
  request.folder = line.positional().front();
  read_rating(line, request.merge.ratings);
  request.merge.allow_missing = line.flag("allow-missing");
  if (const auto top = line.value("top")) request.top = parse_integer("top", *top, 0, kMostListed);
  request.json = line.value("json");
  request.csv = line.value("csv");
  if (request.json) check_output("json", *request.json, {});
  if (request.csv) check_output("csv", *request.csv, {});
  check_different({{"json", request.json}, {"csv", request.csv}});
  return request;
}

std::string merge_help() {
  return fmt::format("{}\nMetrics (KEY):\n  {}\n\n{}\n{}",
                     make_options().help({"Rating", "Output", "Messages"}),
                     fmt::join(analysis::kMetricKeys, "\n  "), kExamples, kMergeExitCodes);
}

}  // namespace scene_analyzer::cli
