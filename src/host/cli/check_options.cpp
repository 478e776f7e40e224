#include "cli/check_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <set>
#include <system_error>

#include "base/error.h"
#include "cli/command_line.h"
#include "cli/measuring_options.h"
#include "cli/output_options.h"
#include "gate/quantity.h"
#include "library/asset_list.h"

namespace scene_analyzer::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPurpose =
    "Compares assets with a budget: limits on sizes, ratings, rendering times and defects, for all assets or "
    "some.\n"
    "Prints a verdict per rule, pass, fail or unchecked with the reason, and what to do about the worst "
    "findings.\n"
    "An ASSET is a file, or a folder with everything below it; each is a scene of its own. With a baseline "
    "only\n"
    "what got worse since it was written fails.\n";

constexpr const char* kExamples =
    "Examples:\n"
    "  scene-analyzer check props/ --init budget.toml       (a first budget, which the assets pass)\n"
    "  scene-analyzer check props/ --budget budget.toml\n"
    "  scene-analyzer check props/ --budget budget.toml --write-baseline baseline\n"
    "  scene-analyzer check props/ --budget budget.toml --baseline baseline --github --sarif out.sarif\n"
    "\n"
    "A budget:\n"
    "  version = 1\n"
    "\n"
    "  [[rule]]\n"
    "  name = \"props\"\n"
    "  assets = \"props/*\"            # globs of paths or file names; default all\n"
    "  meshes = [\"*_lod0\", \"Leg*\"]   # of node or mesh names; default all\n"
    "  severity = \"error\"            # or \"warning\", which never fails the gate\n"
    "  max.triangles = 5000\n"
    "  max.file_bytes = \"5M\"\n"
    "  max.polygons_per_planar_group = 0.5\n"
    "  max.defects.total = 0\n";

constexpr const char* kCheckExitCodes =
    "Exit codes:\n"
    "  0  no rule of severity error fails\n"
    "  1  the gate failed: a rule of severity error fails, or with --strict is unchecked\n"
    "  2  wrong options, a budget or baseline that cannot be read, no usable device, or an error of the "
    "program\n"
    "  3  the gate has not failed, but an asset could not be analysed or a file not be written\n"
    "  130, 143  stopped by Ctrl-C or a termination signal\n";

Options make_options() {
  Options options("scene-analyzer check", kPurpose);
  options.usage("[OPTION...] ASSET... --budget FILE");
  options.add(
      "Gate",
      {
          {"budget", "the budget, TOML; only what it limits is measured, and what --metrics names", "FILE"},
          {"baseline", "what is beyond a limit fails only where it is worse than in this folder", "DIR"},
          {"write-baseline", "keep the present values in this folder, and accept them", "DIR"},
          {"strict", "rules of severity error that are unchecked fail the gate"},
          {"allow-cpu-timing",
           "check rendering times also on a CPU device; without it such rules are unchecked there"},
          {"init", "write a first budget to FILE, which the assets pass, in place of a check", "FILE"},
          {"force", "let --init overwrite FILE"},
      });
  options.add(
      "Output",
      {
          {"json", "write JSON to FILE, or to standard output in place of the table (-)", "FILE|-"},
          {"junit", "write JUnit XML, a test case per rule, to FILE or standard output (-)", "FILE|-"},
          {"sarif", "write SARIF 2.1.0, a result per finding, to FILE or standard output (-)", "FILE|-"},
          {"github",
           "also print annotations for GitHub Actions: the ten worst findings, and the count "
           "of the rest"},
      });
  add_measuring_options(options);
  add_running_options(options);
  add_common_options(options);
  return options;
}

// Files, and the assets of folders as `batch` finds them; each once: another spelling of a name is the same
// asset.
std::vector<std::string> read_assets(const CommandLine& line) {
  check_assets(line.positional(), "check");
  std::set<fs::path> known;
  std::vector<std::string> assets;
  const auto add = [&](const std::string& asset) {
    if (known.insert(fs::path(asset).lexically_normal()).second) assets.push_back(asset);
  };
  for (const std::string& name : line.positional()) {
    std::error_code error;
    if (!fs::is_directory(name, error)) {
      add(name);
      continue;
    }
    const library::AssetList list = library::list_assets({name}, {}, std::cin);
    if (list.assets.empty()) throw UsageError(fmt::format("{}: no asset lies in this folder", name));
    for (const library::ListedAsset& asset : list.assets) add(asset.path);
  }
  return assets;
}

void read_gate(const CommandLine& line, CheckRequest& request) {
  request.budget = line.value("budget");
  request.init = line.value("init");
  request.baseline = read_folder(line, "baseline");
  request.write_baseline = read_folder(line, "write-baseline");
  request.strict = line.flag("strict");
  request.allow_cpu_timing = line.flag("allow-cpu-timing");
  if (!request.budget && !request.init && !request.write_baseline)
    throw UsageError("no budget is named: --budget FILE, or --init FILE to write a first one");
  if (request.budget && request.init)
    throw UsageError("--budget and --init contradict each other: a budget is checked, or written");
  if (request.baseline && request.write_baseline)
    throw UsageError("--baseline and --write-baseline contradict each other: check first, then write");
  if (request.baseline && !request.budget) throw UsageError("--baseline needs a budget: --budget FILE");
  std::error_code error;
  if (request.baseline && !fs::is_directory(*request.baseline, error))
    throw UsageError(fmt::format("--baseline: the folder '{}' does not exist; --write-baseline writes it",
                                 request.baseline->string()));
  if (request.budget && (request.budget->empty() || *request.budget == "-"))
    throw UsageError("--budget needs the name of a file");
}

void check_init(const CommandLine& line, const CheckRequest& request) {
  if (!request.init) {
    if (line.flag("force")) throw UsageError("--force belongs to --init");
    return;
  }
  check_output("init", *request.init, request.assets);
  std::error_code error;
  if (*request.init != "-" && !line.flag("force") && fs::exists(*request.init, error))
    throw UsageError(
        fmt::format("--init: '{}' exists; with --force it is overwritten", request.init->string()));
}

void read_output(const CommandLine& line, CheckRequest& request) {
  request.json = line.value("json");
  request.junit = line.value("junit");
  request.sarif = line.value("sarif");
  request.github = line.flag("github");
  const NamedOutputs outputs = {{"json", request.json}, {"junit", request.junit}, {"sarif", request.sarif}};
  std::vector<std::string> inputs = request.assets;
  if (request.budget) inputs.push_back(request.budget->string());
  for (const auto& [option, path] : outputs) {
    if (path && !request.budget) throw UsageError(fmt::format("--{} needs a budget: --budget FILE", option));
    if (path) check_output(option, *path, inputs);
  }
  check_different(outputs);
  if (request.github && !request.budget) throw UsageError("--github needs a budget: --budget FILE");
  if (request.github && !request.table())
    throw UsageError(
        "--github prints to standard output; --json, --junit and --sarif need file names beside it");
}

}  // namespace

CheckRequest parse_check(std::span<const std::string> arguments) {
  const Options options = make_options();
  const CommandLine line(options, arguments);
  CheckRequest request;
  request.help = line.flag("help");
  if (request.help) return request;
  request.log = log_level(line.flag("quiet"), line.flag("verbose"));
  request.assets = read_assets(line);
  read_gate(line, request);
  check_init(line, request);
  read_output(line, request);
  read_measuring(line, request.pipeline);
  request.choose_metrics = line.value("metrics").has_value();
  request.device = read_running(line, request.pipeline);
  request.pipeline.fingerprint_files = true;  // for their sizes
  return request;
}

std::string check_help() {
  return fmt::format("{}\nWhat max. and min. limit:\n  {}\n\n{}\n{}",
                     make_options().help({"Gate", "Output", "Measuring", "Running", "Messages"}),
                     fmt::join(gate::quantity_keys(), "\n  "), kExamples, kCheckExitCodes);
}

}  // namespace scene_analyzer::cli
