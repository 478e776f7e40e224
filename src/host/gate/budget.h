// budget.h — A budget: what assets and their meshes may cost, as a team writes it down.
//
//   version = 1
//   eye = [0, 1.7, 2]                 # for `distance`; default a three-quarter view of each asset
//
//   [weights]                         # for `aggregate`; default 1 each, but rendering_time 0
//   polygons_per_planar_group = 2
//
//   [[rule]]
//   name = "props"                    # each name once
//   assets = "props/*"                # a glob or several: ["a*", "b*"]; default all
//   meshes = "*_collision"            # of node or mesh names; default all
//   severity = "warning"              # or "error", the default
//   max.triangles = 5000
//   max.file_bytes = "5M"
//   min.relative_density = -0.9
//   max.defects.total = 0
//
// In globs `*` stands for any characters, `/` included, `?` for one, `[abc]` for one of these. A glob of
// assets without `/` is matched against the file's name alone.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/metric.h"
#include "gate/quantity.h"
#include "mesh/scene.h"

namespace scene_analyzer::gate {

// Larger budgets are refused: nobody has written them.
inline constexpr std::size_t kMostBudgetBytes = 1 << 20, kMostRules = 1000, kMostGlobs = 100,
                             kLongestText = 1000;

enum class Severity : std::uint8_t { kError, kWarning };
constexpr std::string_view key_of(Severity severity) {
  return severity == Severity::kError ? "error" : "warning";
}

struct Limit {
  Quantity quantity = Quantity::kTriangles;
  Bound bound = Bound::kMost;
  double value = 0;  // itself still allowed; within the quantity's range
  bool operator==(const Limit&) const = default;
};

struct Rule {
  std::string name;
  std::vector<std::string> assets = {}, meshes = {};  // globs; empty: all
  Severity severity = Severity::kError;
  std::vector<Limit> limits = {};  // at least one, no two of the same quantity and bound
  std::size_t line = 0;            // in the budget, from 1
  bool operator==(const Rule&) const = default;
};

using Weights = std::array<double, analysis::kMetricCount>;
inline constexpr Weights kDefaultWeights = {1, 1, 1, 1, 1, 1, 0};  // times differ between devices

struct Budget {
  std::string file;  // for messages
  std::vector<Rule> rules;
  Weights weights = kDefaultWeights;  // each >= 0, one of them > 0
  std::optional<mesh::Vector3> eye;
};

// Throws UsageError "FILE:LINE:COLUMN: what is wrong, and the remedy" for anything that is not as above.
// Memory: some hundred times the text.
Budget parse_budget(std::string_view text, const std::string& file);
// The same for a file; throws UsageError also where it cannot be read.
Budget read_budget(const std::filesystem::path& file);

// What has to be measured for it.
analysis::MetricSet needed_metrics(const Budget& budget);
// Whether its value comes from rendering times.
bool is_timed(Quantity quantity, const Weights& weights);

bool applies_to_asset(const Rule& rule, const std::string& path);
bool applies_to_mesh(const Rule& rule, const std::string& node, const std::string& mesh);

}  // namespace scene_analyzer::gate
