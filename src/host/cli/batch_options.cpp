#include "cli/batch_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <thread>

#include "base/error.h"
#include "cli/command_line.h"
#include "cli/exit_code.h"
#include "cli/measuring_options.h"
#include "cli/option_parsing.h"
#include "library/output_folder.h"

namespace scene_analyzer::cli {
namespace {

constexpr unsigned kMostJobs = 1024;

constexpr const char* kPurpose =
    "Analyses a library of assets into a folder: folders with everything below them, assets, and lists of\n"
    "assets (one path per line; - is such a list on standard input). One bad asset is a line in the "
    "journal,\n"
    "and the others go on. A run that was stopped, or killed, goes on where it was when it is started "
    "again;\n"
    "what has not changed is not measured again. 'scene-analyzer merge' then rates the library as one "
    "scene.\n";

constexpr const char* kExamples =
    "Examples:\n"
    "  scene-analyzer batch props/ characters/ --out analysed/\n"
    "  scene-analyzer batch library/ --out analysed/ --exclude '*_lod[123].*,old/*' --metrics "
    "polygons_per_planar_group\n"
    "  git diff --name-only main -- '*.glb' | scene-analyzer batch - --out analysed/\n"
    "  scene-analyzer batch library/ --out /shared/analysed --shard-index 0 --shard-count 4   (1, 2, 3 "
    "elsewhere)\n"
    "  sbatch --array=0-15 --wrap 'scene-analyzer batch library/ --out /shared/analysed --shard auto'\n";

constexpr const char* kBatchExitCodes =
    "Exit codes:\n"
    "  0  all assets are analysed\n"
    "  2  wrong options, no usable device, an output folder that cannot be written, a device that was lost\n"
    "     time and again, or an error of the program: the same command goes on from there\n"
    "  3  some assets could not be analysed; the journal says why, and all others are done\n"
    "  130, 143  stopped by Ctrl-C or a termination signal, within a second: the same command goes on from "
    "there\n";

Options make_options() {
  Options options("scene-analyzer batch", kPurpose);
  options.usage("[OPTION...] --out DIR LIBRARY...");
  options.add(
      "Library",
      {
          {"out", "folder for analysis files and journal; several tasks may share it, also over a network",
           "DIR"},
          {"include",
           "which files of folders are assets, in place of all with an extension that Assimp reads; * stands "
           "for any characters, / included, and the path below the folder is looked at",
           "GLOB,..."},
          {"exclude", "which files of folders are no assets", "GLOB,..."},
          {"jobs", "assets read at the same time, beside the measuring; default one per processor", "N"},
          {"shard-index", "analyse only this part of the library, from 0; with --shard-count", "I"},
          {"shard-count", "into how many parts of about the same size the library is cut", "N"},
          {"shard",
           "auto: take both from the scheduler: Slurm's job arrays (SLURM_ARRAY_TASK_ID and those beside "
           "it), Kubernetes' Indexed Jobs (JOB_COMPLETION_INDEX, with SHARD_COUNT set to the completions), "
           "or GTEST_SHARD_INDEX with GTEST_TOTAL_SHARDS",
           "auto"},
      });
  add_measuring_options(options);
  add_device_options(options);
  add_common_options(options);
  return options;
}

std::vector<std::string> read_globs(const CommandLine& line, const std::string& option) {
  std::vector<std::string> globs;
  const auto text = line.value(option);
  if (!text) return globs;
  std::string_view rest = *text;
  while (true) {
    const std::size_t comma = rest.find(',');
    const std::string_view glob = rest.substr(0, comma);
    if (glob.empty())
      throw UsageError(
          fmt::format("--{}: '{}' has an empty glob; write for example *.glb,*.obj", option, *text));
    globs.emplace_back(glob);
    if (comma == std::string_view::npos) return globs;
    rest.remove_prefix(comma + 1);
  }
}

library::Shard read_shard(const CommandLine& line, const library::Environment& environment) {
  const auto index = line.value("shard-index"), count = line.value("shard-count"), from = line.value("shard");
  if (from) {
    if (index || count)
      throw UsageError("--shard auto and --shard-index or --shard-count contradict each other");
    if (*from != "auto")
      throw UsageError(
          fmt::format("--shard: '{}' is unknown; auto, or --shard-index I --shard-count N", *from));
    return library::shard_from_environment(environment);
  }
  if (!index && !count) return {};
  if (!index || !count)
    throw UsageError("--shard-index and --shard-count belong together; one of them is missing");
  library::Shard shard;
  shard.count = static_cast<std::uint32_t>(parse_integer("shard-count", *count, 1, library::kMostShards));
  shard.index = static_cast<std::uint32_t>(parse_integer("shard-index", *index, 0, library::kMostShards - 1));
  if (shard.index >= shard.count)
    throw UsageError(fmt::format("--shard-index: {} is too large: {} shards are 0 to {}", shard.index,
                                 shard.count, shard.count - 1));
  return shard;
}

unsigned read_jobs(const CommandLine& line) {
  if (const auto jobs = line.value("jobs"))
    return static_cast<unsigned>(parse_integer("jobs", *jobs, 1, kMostJobs));
  return std::clamp(std::thread::hardware_concurrency(), 1U, kMostJobs);
}

}  // namespace

BatchRequest parse_batch(std::span<const std::string> arguments, const library::Environment& environment) {
  Options options = make_options();
  const CommandLine line(options, arguments);
  BatchRequest request;
  request.help = line.flag("help");
  if (request.help) return request;
  request.log = log_level(line.flag("quiet"), line.flag("verbose"));
  request.inputs = line.positional();
  if (request.inputs.empty())
    throw UsageError(
        "no library is named; write folders, assets or lists of assets, for example: scene-analyzer batch "
        "library/ --out analysed/");
  if (std::ranges::count(request.inputs, "-") > 1) throw UsageError("standard input (-) is named twice");
  const auto out = read_folder(line, "out");
  if (!out) throw UsageError("--out is missing: the folder for analysis files and journal");
  request.out = *out;
  request.filter = {read_globs(line, "include"), read_globs(line, "exclude")};
  request.jobs = read_jobs(line);
  request.shard = read_shard(line, environment);
  read_measuring(line, request.pipeline);
  request.device = read_device(line, request.pipeline);
  request.pipeline.cache_folder = library::analyses_folder(request.out);
  return request;
}

std::string batch_help() {
  return fmt::format("{}\n{}\n{}\n{}", make_options().help({"Library", "Measuring", "Running", "Messages"}),
                     metric_help(), kExamples, kBatchExitCodes);
}

}  // namespace scene_analyzer::cli
