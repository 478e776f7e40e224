// Budgets: any text is a budget whose limits can be met, or UsageError with file, line and column.
#include "gate/budget.h"

#include <cmath>

#include "base/error.h"
#include "target.h"

namespace scene_analyzer::fuzz {

std::vector<std::string> seeds() {
  return {
      "version = 1\n[[rule]]\nname = \"size\"\nmax.triangles = 5000\nmax.file_bytes = \"5M\"\n",
      "version = 1\neye = [0, 1.7, -2]\n[weights]\ndistance = 2\nrelative_density = 0.5\n\n[[rule]]\n"
      "name = \"props\"\nassets = \"props/*\"\nmeshes = [\"*_lod0\", \"Leg?\"]\nseverity = \"warning\"\n"
      "max.aggregate = 0.5\nmin.relative_density = -0.5\nmax.defects.total = 0\n",
      "version = 1\nrule = [{name = 'a', max = {defects = {boundary_edges = 12}, rendering_time_ms = "
      "0.25}}]\n",
      "version = 1\n[[rule]]\nname = \"\"\"\na \\\n b\"\"\"\nmax.\"triangles\" = 0x1F\nmin.distance = 1e-3\n",
      "version = 1\n[[rule]]\nname = \"a\"\nmax.triangels = nan\n[[rule]]\nname = \"a\"\nmax.triangles = "
      "inf\n",
  };
}

namespace {

void check(const gate::Budget& budget) {
  require(!budget.rules.empty() && budget.rules.size() <= gate::kMostRules, "a budget has rules");
  for (const gate::Rule& rule : budget.rules) {
    require(!rule.name.empty() && !rule.limits.empty(), "a rule has a name and limits");
    require(rule.line > 0, "a rule has a line");
    for (const gate::Limit& limit : rule.limits) {
      const gate::QuantityInfo& about = gate::info(limit.quantity);
      require(limit.value >= about.least && limit.value <= about.greatest, "a limit lies in its range");
      require(!about.whole || limit.value == std::floor(limit.value), "counts are whole");
    }
  }
  double sum = 0;
  for (const double weight : budget.weights) {
    require(weight >= 0 && std::isfinite(weight), "weights are at least 0");
    sum += weight;
  }
  require(sum > 0, "some weight is above 0");
  if (budget.eye)
    for (const double coordinate : *budget.eye) require(std::isfinite(coordinate), "points are finite");
}

}  // namespace
}  // namespace scene_analyzer::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scene_analyzer;
  try {
    fuzz::check(gate::parse_budget(fuzz::text_of(data, size), "b.toml"));
  } catch (const UsageError& error) {
    fuzz::require(std::string_view(error.what()).starts_with("b.toml:"), "a refusal names the file");
  }
  return 0;
}
