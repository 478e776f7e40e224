// evaluate.h — Budget + assets (+ baseline) -> a verdict per rule. Pure functions: no GPU, no files.
//
// A verdict is never `pass` by silence: a rule that matches nothing, or a value that is not there, is
// unchecked, and says why.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gate/asset_state.h"
#include "gate/baseline.h"
#include "gate/budget.h"

namespace scene_analyzer::gate {

enum class Verdict : std::uint8_t { kPass, kFail, kUnchecked };
inline constexpr std::array<std::string_view, 3> kVerdictKeys = {"pass", "fail", "unchecked"};

// Listings hold no more than these; counts always tell all.
inline constexpr std::size_t kMostFindings = 1000, kMostFindingsPerRule = 50, kMostReasons = 10;

// A value beyond a limit.
struct Finding {
  std::size_t rule = 0;  // index into the budget's rules
  Severity severity = Severity::kError;
  Limit limit;
  double value = 0;
  std::optional<double> baseline = {};   // which the value is worse than
  std::size_t asset = 0;                 // index into the assets
  std::optional<std::size_t> mesh = {};  // index into the asset's rated meshes; none: the whole asset
  std::uint64_t others = 0;              // further instances of the mesh, with the same value
  std::uint64_t number = 0;              // in the order found; no two are equal
  std::string path = {}, node = {},
              name = {};  // of the asset, the mesh's node, the mesh; as the file has them

  // Value / limit where both are positive: how far beyond, 1 at the limit. Infinite where the limit is 0.
  double ratio() const;
};
// Errors first, then the farthest beyond its limit.
bool operator<(const Finding& a, const Finding& b);

// Why values were not checked.
struct Reason {
  std::string text;
  std::uint64_t count = 0;   // of values
  std::string example = {};  // asset, or asset and mesh; or empty
};

struct RuleResult {
  Verdict verdict = Verdict::kUnchecked;
  std::uint64_t assets = 0, meshes = 0;  // that it applies to; meshes: instances
  std::uint64_t checked = 0;             // values that were compared with a limit
  std::uint64_t findings = 0;
  std::uint64_t tolerated = 0;  // values beyond a limit that are no worse than the baseline's
  std::uint64_t unchecked = 0;  // values that could not be compared, and globs that match nothing
  std::vector<Reason> reasons;  // of those, the first kMostReasons; the last counts the rest
  std::vector<Finding> worst;   // the first kMostFindingsPerRule
};

struct CheckResult {
  std::vector<RuleResult> rules;  // as in the budget
  std::vector<Finding> worst;     // of all rules, the first kMostFindings
  std::uint64_t errors = 0, warnings = 0, tolerated = 0, checked = 0, unchecked = 0;  // all
  std::array<std::uint64_t, 3> verdicts{};                                            // rules, by Verdict
  std::uint64_t new_assets = 0;  // that the baseline does not have
  bool failed = false;           // the gate: the exit code is 1
};

struct CheckOptions {
  bool strict = false;            // rules of severity error that are unchecked fail the gate
  bool allow_cpu_timing = false;  // rendering times of a CPU device count
  std::string cpu_device = {};    // whose rendering times were not measured for that reason
  const Baselines* baselines = nullptr;
};

// Cost: rules times meshes, in time; memory for what is listed.
CheckResult evaluate(const Budget& budget, std::span<const AssetState> assets, const CheckOptions& options);

// "chair.glb: Leg", "chair.glb", with the names as they are in the files.
std::string place_text(const std::string& path, const std::string& node, const std::string& mesh);

}  // namespace scene_analyzer::gate
