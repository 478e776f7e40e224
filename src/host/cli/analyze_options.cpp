#include "cli/analyze_options.h"

#include <fmt/format.h>

#include <limits>
#include <tuple>

#include "base/error.h"
#include "cli/command_line.h"
#include "cli/exit_code.h"
#include "cli/measuring_options.h"
#include "cli/option_parsing.h"
#include "cli/output_options.h"

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
    "  scene-analyzer analyze room.glb --defects\n"
    "  scene-analyzer analyze room.glb --eye -1,2,3 --weights distance=1,relative_density=2\n"
    "  scene-analyzer analyze room.glb --image room.png --metric relative_density --emphasis extremes\n"
    "  scene-analyzer analyze scan.stl --alpha 2.5 --weld-tolerance 1e-4 --metrics "
    "polygons_per_planar_group\n"
    "  scene-analyzer analyze --quiet --json - -- -odd-name.obj | jq '.meshes[].aggregate'\n";

Options make_options() {
  Options options("scene-analyzer analyze", kPurpose);
  options.usage("[OPTION...] ASSET...");
  add_measuring_options(options);
  options.add(
      "Rating",
      {
          {"eye",
           "where the scene is seen from, world units; default a three-quarter view of the whole scene",
           "X,Y,Z"},
          {"weights", "share of each metric in the aggregate, at least 0, those not named 0; default 1 each",
           "KEY=W,..."},
          {"relative",
           "map each metric from its range within the scene to its whole range before aggregating"},
      });
  options.add("Output",
              {
                  {"defects",
                   "print a second table: what is wrong with each mesh (degenerate and duplicate triangles, "
                   "holes, edges of more than two triangles, flipped neighbours, loose or mergeable vertices "
                   "and more), how often, the first triangles or vertices to look at, counted from 0 in the "
                   "file's mesh, and what to do about it. JSON and CSV always have these counts"},
                  {"json", "write JSON to FILE, or to standard output in place of the table (-)", "FILE|-"},
                  {"csv", "write CSV to FILE, or to standard output in place of the table (-)", "FILE|-"},
                  {"histograms",
                   "write how often areas of triangles meet, per mesh a table (.csv) and a picture (.svg), "
                   "into DIR; computes even where an analysis file is valid",
                   "DIR"},
                  {"signals",
                   "write what R_ft is computed from, per mesh the triangles' areas in their order and their "
                   "spectrum as tables (-signal.csv, -spectrum.csv) and both as a picture (-signal.svg), "
                   "into DIR; computes like --histograms",
                   "DIR"},
              });
  add_picture_options(options);
  add_running_options(options);
  add_common_options(options);
  return options;
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

void read_output(const CommandLine& line, AnalyzeRequest& request) {
  request.defects = line.flag("defects");
  request.json = line.value("json");
  request.csv = line.value("csv");
  if (request.json) check_output("json", *request.json, request.assets);
  if (request.csv) check_output("csv", *request.csv, request.assets);
  if (request.pictures.image) check_output("image", *request.pictures.image, request.assets);
  if (request.export_file) check_output("export", *request.export_file, request.assets);
  check_different({{"json", request.json},
                   {"csv", request.csv},
                   {"image", request.pictures.image},
                   {"export", request.export_file}});
}

}  // namespace

AnalyzeRequest parse_analyze(std::span<const std::string> arguments) {
  Options options = make_options();
  const CommandLine line(options, arguments);
  AnalyzeRequest request;
  request.help = line.flag("help");
  if (request.help) return request;
  request.log = log_level(line.flag("quiet"), line.flag("verbose"));
  request.assets = line.positional();
  read_measuring(line, request.pipeline);
  read_rating(line, request.pipeline.metrics, request.ratings);
  request.device = read_running(line, request.pipeline);
  check_assets(request.assets, "analyze");
  request.export_file = read_export(line);
  request.pictures = read_pictures(line, request.pipeline.metrics, request.ratings.relative);
  request.pictures.image_set = read_folder(line, "image-set");
  const auto folder = [](const fs::path& path) { return (path / "").lexically_normal(); };
  if (request.pictures.image && request.pictures.image_set &&
      folder(request.pictures.image->parent_path()) == folder(*request.pictures.image_set))
    throw UsageError(
        "--image: the file lies in the folder of --image-set, which may write the same name; choose another "
        "place");
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
