// The arguments of `analyze`, one per line: a request that keeps every promise of its options, or UsageError.
#include "cli/command_line.h"

#include <cmath>

#include "base/error.h"
#include "cli/analyze_options.h"
#include "target.h"

namespace scene_analyzer::fuzz {

std::vector<std::string> seeds() {
  return {"room.glb\n--json\nscene.json\n--csv\n-\n--eye\n-1,2,3\n--weights\ndistance=1,relative_density=2",
          "--image\nroom.png\n--metric\nrelative_density\n--emphasis\nextremes\n--size\n640x480\nroom.glb",
          "scan.stl\n--alpha\n2.5\n--weld-tolerance=1e-4\n--metrics\npolygons_per_planar_group,distance",
          "--quiet\n--json\n-\n--\n-odd-name.obj",
          "--import-memory\n2G\n--import-timeout\n5\n--max-triangles\n1000\nroom.glb",
          "-v\n--no-cache\n--relative\n--dim=20\n--steps\n4\n--timing-size\n64x64\n--timing-budget\n1\na\nb",
          "--start-searches\n7\n--device\n0\n--cache-dir\n/nowhere\n--export\nout.glb\nx.obj",
          "--help"};
}

namespace {

std::vector<std::string> lines(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    // What the system hands over as an argument ends at a zero byte.
    const std::string_view line = text.substr(0, end);
    lines.emplace_back(line.substr(0, line.find('\0')));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

void check(const cli::AnalyzeRequest& request) {
  if (request.help) return;
  require(!request.assets.empty(), "an asset is named");
  for (const std::string& asset : request.assets) require(!asset.empty(), "every asset has a name");
  const auto& parameters = request.pipeline.parameters;
  require(parameters.alpha_degrees >= 0 && parameters.alpha_degrees <= 180, "alpha is an angle");
  require(parameters.dim >= 2 && parameters.start_searches >= 1, "counts are above their least value");
  require(parameters.weld_tolerance >= 0 && std::isfinite(parameters.weld_tolerance),
          "a tolerance is a length");
  require(parameters.steps >= 1 && parameters.steps <= 256, "steps are 1 to 256");
  require(request.pipeline.metrics.any(), "some metric is computed");
  require(request.pipeline.import_limits.seconds > 0, "a time limit is above 0");
  require(request.json != "-" || request.csv != "-", "one thing at most goes to standard output");
}

}  // namespace
}  // namespace scene_analyzer::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scene_analyzer;
  try {
    fuzz::check(cli::parse_analyze(fuzz::lines(fuzz::text_of(data, size))));
  } catch (const UsageError& error) {
    fuzz::require(*error.what() != '\0', "a refusal has a reason");
  }
  return 0;
}
