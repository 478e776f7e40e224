#include "cli/analyze_options.h"

#include <fmt/format.h>

#include <limits>
#include <tuple>

#include "base/error.h"
#include "cli/command_line.h"
#include "cli/exit_code.h"
#include "cli/option_parsing.h"

namespace scene_analyzer::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPurpose =
    "Rates every mesh of one or several 3D assets, which together form one scene: what is too dense, "
    "redundant or\n"
    "uneven. Prints a table; results are kept beside each asset and make the next run instant.\n";

constexpr const char* kExamples =
    "Examples:\n"
    "  scene-analyzer analyze room.glb\n"
    "  scene-analyzer analyze room.glb lamp.obj --json scene.json --csv scene.csv\n"
    "  scene-analyzer analyze room.glb --eye -1,2,3 --weights distance=1,relative_density=2\n"
    "  scene-analyzer analyze room.glb --image room.png --metric relative_density --emphasis extremes\n"
    "  scene-analyzer analyze scan.stl --alpha 2.5 --weld-tolerance 1e-4 --metrics "
    "polygons_per_planar_group\n"
    "  scene-analyzer analyze --quiet --json - -- -odd-name.obj | jq '.meshes[].aggregate'\n";

std::string metric_help() {
  return fmt::format(
      "Metrics (KEY):\n  {}\nrendering_time takes longest by far; a CPU device's times say nothing about a "
      "GPU.\n",
      fmt::join(analysis::kMetricKeys, "\n  "));
}

cxxopts::Options make_options() {
  cxxopts::Options options("scene-analyzer analyze", kPurpose);
  options.custom_help("[OPTION...] ASSET...").set_width(110);
  const auto text = [] { return cxxopts::value<std::string>(); };
  options.add_options("Measuring")(
      "alpha", "planar groups: largest angle between neighbouring triangles, degrees in [0, 180], default 0",
      text(), "DEG")("dim", "co-occurrence: largest number of distinct areas, at least 2, default 20000",
                     text(), "N")(
      "steps", "rendering time: rotations about each axis, 1 to 256, default 8: 64 draws of every mesh",
      text(), "N")("timing-size", "rendering time: size of the picture drawn, default 512x512", text(),
                   "WxH")("timing-budget",
                          "rendering time: seconds for all meshes of an asset together, default 30; less "
                          "where the times are sure "
                          "earlier",
                          text(), "S")(
      "start-searches",
      "Fourier transform: most work on finding where the signal starts, the triangle farthest from all "
      "others "
      "of its part of the mesh; counted in walks over the whole part, at least 1, default 20000. Where the "
      "work "
      "ends before that triangle is proven, the table marks R_ft with ~ and names the gap: how much farther "
      "another triangle may lie, at most. A larger N narrows it",
      text(), "N")("weld-tolerance",
                   "distance up to which vertices are one, in units of the file, at least 0, default 0",
                   text(), "L")("metrics", "compute only these, default all", text(), "KEY,...");
  options.add_options("Rating")(
      "eye", "where the scene is seen from, world units; default a three-quarter view of the whole scene",
      text(), "X,Y,Z")("weights",
                       "share of each metric in the aggregate, at least 0, those not named 0; default 1 each",
                       text(), "KEY=W,...")(
      "relative", "map each metric from its range within the scene to its whole range before aggregating");
  options.add_options("Output")("json", "write JSON to FILE, or to standard output in place of the table (-)",
                                text(), "FILE|-")(
      "csv", "write CSV to FILE, or to standard output in place of the table (-)", text(), "FILE|-")(
      "histograms",
      "write how often areas of triangles meet, per mesh a table (.csv) and a picture (.svg), into DIR; "
      "computes even where an analysis file is valid",
      text(), "DIR")("signals",
                     "write what R_ft is computed from, per mesh the triangles' areas in their order and "
                     "their spectrum as tables "
                     "(-signal.csv, -spectrum.csv) and both as a picture (-signal.svg), into DIR; computes "
                     "like --histograms",
                     text(), "DIR");
  add_picture_options(options);
  options.add_options("Running")(
      "device", "index or part of the name as printed by 'scene-analyzer devices'; default the fastest kind",
      text(), "D")("cache-dir", "keep analysis files below DIR, default beside each asset", text(), "DIR")(
      "no-cache", "neither read nor write analysis files");
  add_common_options(options);
  return options;
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

void read_rating(const CommandLine& line, analysis::MetricSet metrics, ratings::Options& options) {
  options.metrics = metrics;
  options.relative = line.flag("relative");
  if (const auto eye = line.value("eye")) options.eye = parse_vector3("eye", *eye);
  const auto weights = line.value("weights");
  if (!weights) return;
  options.weights = parse_weights("weights", *weights);
  bool weighs_something = false;
  for (std::size_t i = 0; i < options.weights.size(); ++i)
    weighs_something = weighs_something || (metrics[i] && options.weights[i] > 0);
  if (!weighs_something)
    throw UsageError(
        fmt::format("--weights: '{}' gives no weight to any metric that --metrics asks for", *weights));
}

// Found out now, not after minutes of work.
void check_output(const std::string& option, const fs::path& path, const std::vector<std::string>& assets) {
  if (path == "-") return;
  std::error_code ignored;  // an unreadable path is reported when it is written
  if (path.empty()) throw UsageError(fmt::format("--{} needs a file name, or - for standard output", option));
  if (fs::is_directory(path, ignored))
    throw UsageError(fmt::format("--{}: '{}' is a folder; a file name is needed", option, path.string()));
  if (path.has_parent_path() && !fs::is_directory(path.parent_path(), ignored))
    throw UsageError(
        fmt::format("--{}: the folder '{}' does not exist", option, path.parent_path().string()));
  for (const std::string& asset : assets)
    if (fs::equivalent(path, asset, ignored))
      throw UsageError(
          fmt::format("--{}: '{}' is one of the assets and would be overwritten", option, path.string()));
}

void check_different(const std::vector<std::pair<std::string, std::optional<fs::path>>>& outputs) {
  for (auto a = outputs.begin(); a != outputs.end(); ++a)
    for (auto b = a + 1; b != outputs.end(); ++b)
      if (a->second && b->second && a->second->lexically_normal() == b->second->lexically_normal())
        throw UsageError(
            fmt::format("--{} and --{} name the same file '{}'", a->first, b->first, a->second->string()));
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

void read_output(const CommandLine& line, AnalyzeRequest& request) {
  request.json = line.value("json");
  request.csv = line.value("csv");
  if (request.json == "-" && request.csv == "-")
    throw UsageError("--json - and --csv - both ask for standard output; one of them needs a file name");
  if (request.json) check_output("json", *request.json, request.assets);
  if (request.csv) check_output("csv", *request.csv, request.assets);
  if (request.pictures.image) check_output("image", *request.pictures.image, request.assets);
  if (request.export_file) check_output("export", *request.export_file, request.assets);
  check_different({{"json", request.json},
                   {"csv", request.csv},
                   {"image", request.pictures.image},
                   {"export", request.export_file}});
}

void read_running(const CommandLine& line, AnalyzeRequest& request) {
  if (const auto device = line.value("device")) {
    if (device->empty())
      throw UsageError("--device needs an index or a part of a name; see 'scene-analyzer devices'");
    request.device = *device;
    request.pipeline.this_device_only = true;
  }
  request.pipeline.use_analysis_files = !line.flag("no-cache");
  request.pipeline.cache_folder = read_folder(line, "cache-dir");
  if (request.pipeline.cache_folder && !request.pipeline.use_analysis_files)
    throw UsageError("--cache-dir and --no-cache contradict each other; leave one of them out");
}

}  // namespace

AnalyzeRequest parse_analyze(std::span<const std::string> arguments) {
  cxxopts::Options options = make_options();
  const CommandLine line(options, arguments);
  AnalyzeRequest request;
  request.help = line.flag("help");
  if (request.help) return request;
  request.log = log_level(line.flag("quiet"), line.flag("verbose"));
  request.assets = line.positional();
  read_measuring(line, request.pipeline);
  read_rating(line, request.pipeline.metrics, request.ratings);
  read_running(line, request);
  if (request.assets.empty())
    throw UsageError(
        "no asset is named; write the files to analyse, for example: scene-analyzer analyze room.glb");
  for (const std::string& asset : request.assets)
    if (asset.empty())
      throw UsageError("an asset's name is empty; is a variable of the calling script unset?");
  request.export_file = read_export(line);
  request.pictures = read_pictures(line, request.pipeline.metrics, request.ratings.relative);
  request.pictures.image_set = read_folder(line, "image-set");
  read_output(line, request);
  request.histograms = read_folder(line, "histograms");
  request.signals = read_folder(line, "signals");
  return request;
}

std::string analyze_help() {
  return fmt::format(
      "{}\n{}\n{}\n{}",
      make_options().help({"Measuring", "Rating", "Output", "Pictures", "Running", "Messages"}),
      metric_help(), kExamples, kExitCodeHelp);
}

}  // namespace scene_analyzer::cli
