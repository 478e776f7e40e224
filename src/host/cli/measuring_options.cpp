#include "cli/measuring_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <tuple>

#include "base/error.h"
#include "cli/option_parsing.h"

namespace scene_analyzer::cli {

namespace fs = std::filesystem;

std::string metric_help() {
  return fmt::format(
      "Metrics (KEY):\n  {}\nrendering_time takes longest by far; a CPU device's times say nothing about a "
      "GPU.\n",
      fmt::join(analysis::kMetricKeys, "\n  "));
}

void add_measuring_options(Options& options) {
  options.add(
      "Measuring",
      {
          {"alpha",
           "planar groups: largest angle between neighbouring triangles, degrees in [0, 180], default 0",
           "DEG"},
          {"dim", "co-occurrence: largest number of distinct areas, at least 2, default 20000", "N"},
          {"steps", "rendering time: rotations about each axis, 1 to 256, default 8: 64 draws of every mesh",
           "N"},
          {"timing-size", "rendering time: size of the picture drawn, default 512x512", "WxH"},
          {"timing-budget",
           "rendering time: seconds for all meshes of an asset together, default 30; less where the times "
           "are sure earlier",
           "S"},
          {"start-searches",
           "Fourier transform: most work on finding where the signal starts, the triangle farthest from all "
           "others of its part of the mesh; counted in walks over the whole part, at least 1, default 20000. "
           "Where the work ends before that triangle is proven, the table marks R_ft with ~ and names the "
           "gap: how much farther another triangle may lie, at most. A larger N narrows it",
           "N"},
          {"weld-tolerance",
           "distance up to which vertices are one, in units of the file, at least 0, default 0", "L"},
          {"metrics", "compute only these, default all", "KEY,..."},
      });
}

void add_device_options(Options& options) {
  options.add(
      "Running",
      {
          {"device",
           "index or part of the name as printed by 'scene-analyzer devices'; default the fastest kind", "D"},
          {"import-memory",
           "memory that reading an asset may take, default 4G and 32 bytes per byte of the file, at most "
           "what the machine has",
           "SIZE"},
          {"import-timeout", "seconds that reading an asset may take, default 120", "S"},
          {"max-triangles",
           "refuse assets of more triangles, those of a mesh counted once however often it is placed; "
           "default no limit",
           "N"},
      });
}

void add_running_options(Options& options) {
  add_device_options(options);
  options.add("Running", {
                             {"cache-dir", "keep analysis files below DIR, default beside each asset", "DIR"},
                             {"no-cache", "neither read nor write analysis files"},
                         });
}

void read_measuring(const CommandLine& line, pipeline::Options& options) {
  auto& parameters = options.parameters;
  if (const auto alpha = line.value("alpha"))
    parameters.alpha_degrees = parse_number("alpha", *alpha, 0, 180, "degrees");
  if (const auto dim = line.value("dim"))
    parameters.dim =
        static_cast<std::uint32_t>(parse_integer("dim", *dim, 2, std::numeric_limits<std::uint32_t>::max()));
  if (const auto steps = line.value("steps"))
    parameters.steps =
        static_cast<std::uint32_t>(parse_integer("steps", *steps, 1, render_timing::kMostSteps));
  // No mesh has more triangles than the greatest, and so many searches prove every start.
  if (const auto searches = line.value("start-searches"))
    parameters.start_searches =
        parse_integer("start-searches", *searches, 1, std::numeric_limits<std::uint32_t>::max());
  if (const auto tolerance = line.value("weld-tolerance"))
    parameters.weld_tolerance = parse_number("weld-tolerance", *tolerance, 0,
                                             std::numeric_limits<double>::max(), "units of the file");
  if (const auto size = line.value("timing-size"))
    std::tie(options.timing_width, options.timing_height) = parse_pixels("timing-size", *size);
  if (const auto budget = line.value("timing-budget"))
    options.timing_budget = parse_number("timing-budget", *budget, 0.001, 86400, "seconds");
  if (const auto metrics = line.value("metrics")) options.metrics = parse_metrics("metrics", *metrics);
}

std::optional<fs::path> read_folder(const CommandLine& line, const std::string& option) {
  const auto folder = line.value(option);
  if (!folder) return std::nullopt;
  if (folder->empty()) throw UsageError(fmt::format("--{} needs a folder", option));
  std::error_code ignored;
  if (fs::exists(*folder, ignored) && !fs::is_directory(*folder, ignored))
    throw UsageError(fmt::format("--{}: '{}' is a file; a folder is needed", option, *folder));
  return *folder;
}

namespace {

// Below it the worker has no room for its own code.
constexpr std::uint64_t kLeastImportMemory = std::uint64_t{64} << 20;

void read_limits(const CommandLine& line, import::Limits& limits) {
  if (const auto size = line.value("import-memory")) {
    limits.memory_bytes = parse_size("import-memory", *size);
    if (limits.memory_bytes < kLeastImportMemory)
      throw UsageError(
          fmt::format("--import-memory: '{}' is less than 64M; no asset can be read with it", *size));
  }
  if (const auto seconds = line.value("import-timeout"))
    limits.seconds = parse_number("import-timeout", *seconds, 0.001, 86400, "seconds");
  if (const auto triangles = line.value("max-triangles"))
    limits.triangles =
        parse_integer("max-triangles", *triangles, 1, std::numeric_limits<std::uint32_t>::max());
}

}  // namespace

std::string read_device(const CommandLine& line, pipeline::Options& options) {
  read_limits(line, options.import_limits);
  std::string selector;
  if (const auto device = line.value("device")) {
    if (device->empty())
      throw UsageError("--device needs an index or a part of a name; see 'scene-analyzer devices'");
    selector = *device;
    options.this_device_only = true;
  }
  return selector;
}

std::string read_running(const CommandLine& line, pipeline::Options& options) {
  const std::string selector = read_device(line, options);
  options.use_analysis_files = !line.flag("no-cache");
  options.cache_folder = read_folder(line, "cache-dir");
  if (options.cache_folder && !options.use_analysis_files)
    throw UsageError("--cache-dir and --no-cache contradict each other; leave one of them out");
  return selector;
}

void check_assets(const std::vector<std::string>& assets, const char* command) {
  if (assets.empty())
    throw UsageError(fmt::format(
        "no asset is named; write the files to analyse, for example: scene-analyzer {} room.glb", command));
  for (const std::string& asset : assets)
    if (asset.empty())
      throw UsageError("an asset's name is empty; is a variable of the calling script unset?");
}

}  // namespace scene_analyzer::cli
