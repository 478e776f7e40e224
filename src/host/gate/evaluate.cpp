#include "gate/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "gate/worst.h"

namespace scene_analyzer::gate {
namespace {

// Meshes of one asset that a rule applies to, and of each geometry the first of them.
struct Matched {
  struct First {
    std::size_t mesh = 0;
    std::uint64_t others = 0;
  };
  std::vector<std::size_t> instances;
  std::vector<First> geometries;
};

Matched match(const Rule& rule, const AssetState& asset) {
  Matched matched;
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> place(asset.analysis->geometries.size(), kNone);
  for (std::size_t i = 0; i < asset.rating.meshes.size(); ++i) {
    const analysis::InstanceAnalysis& instance = instance_of(asset, i);
    if (!applies_to_mesh(rule, instance.node, instance.mesh)) continue;
    matched.instances.push_back(i);
    std::size_t& known = place[instance.geometry];
    if (known == kNone) {
      known = matched.geometries.size();
      matched.geometries.push_back({i, 0});
    } else {
      ++matched.geometries[known].others;
    }
  }
  return matched;
}

bool has_scope(const Rule& rule, bool of_asset) {
  return std::ranges::any_of(rule.limits, [&](const Limit& limit) {
    return (info(limit.quantity).scope == Scope::kAsset) == of_asset;
  });
}

bool is_beyond(const Limit& limit, double value) {
  return limit.bound == Bound::kMost ? value > limit.value : value < limit.value;
}

void add_reason(RuleResult& result, const std::string& text, const std::string& example) {
  ++result.unchecked;
  const auto known = std::ranges::find(result.reasons, text, &Reason::text);
  if (known != result.reasons.end()) {
    ++known->count;
  } else if (result.reasons.size() < kMostReasons) {
    result.reasons.push_back({text, 1, example});
  } else if (result.reasons.back().text != "other reasons") {
    result.reasons.back() = {"other reasons", result.reasons.back().count + 1, result.reasons.back().example};
  } else {
    ++result.reasons.back().count;
  }
}

// One rule over all assets, one after the other.
class RuleCheck {
 public:
  RuleCheck(const Budget& budget, std::size_t rule, const CheckOptions& options, Worst<Finding>& all)
      : budget_(budget), rule_(budget.rules[rule]), index_(rule), options_(options), all_(all) {}

  void add(const AssetState& asset, std::size_t index, const AssetBaseline* baseline,
           std::span<const std::optional<std::size_t>> matches) {
    if (!applies_to_asset(rule_, asset.path)) return;
    ++result_.assets;
    // Why it could not stands beside the asset, once for all rules.
    if (!asset.failure.empty()) return add_reason(result_, "the asset could not be analysed", asset.path);
    ++analysed_;
    asset_ = &asset, asset_index_ = index, baseline_ = baseline, matches_ = matches;
    for (const Limit& limit : rule_.limits)
      if (info(limit.quantity).scope == Scope::kAsset)
        check(limit, std::nullopt, 0, asset_value(asset, limit.quantity));
    if (has_scope(rule_, false)) check_meshes(match(rule_, asset));
  }

  RuleResult take(std::size_t assets) {
    if (result_.assets == 0)
      add_reason(result_,
                 fmt::format("it applies to none of the assets ({}): its globs match nothing", assets), "");
    else if (analysed_ > 0 && has_scope(rule_, false) && result_.meshes == 0)
      add_reason(result_, "it applies to no mesh: its globs match nothing", "");
    result_.worst = worst_.take();
    result_.verdict = result_.findings > 0    ? Verdict::kFail
                      : result_.unchecked > 0 ? Verdict::kUnchecked
                                              : Verdict::kPass;
    return std::move(result_);
  }

 private:
  void check_meshes(const Matched& matched) {
    result_.meshes += matched.instances.size();
    for (const Limit& limit : rule_.limits) {
      const Scope scope = info(limit.quantity).scope;
      if (scope == Scope::kGeometry)
        for (const Matched::First& first : matched.geometries)
          check(limit, first.mesh, first.others, mesh_value(*asset_, first.mesh, limit.quantity));
      else if (scope == Scope::kInstance)
        for (const std::size_t mesh : matched.instances)
          check(limit, mesh, 0, mesh_value(*asset_, mesh, limit.quantity));
    }
  }

  void check(const Limit& limit, std::optional<std::size_t> mesh, std::uint64_t others, Value value) {
    if (std::string why = why_no_time(limit.quantity); !why.empty()) value = {std::nullopt, std::move(why)};
    if (!value.number)
      return add_reason(result_, fmt::format("{}: {}", info(limit.quantity).key, value.why_not), place(mesh));
    if (!is_beyond(limit, *value.number)) {
      ++result_.checked;
      return;
    }
    const std::optional<double> before = baseline_value(limit.quantity, mesh);
    if (before && is_timed(limit.quantity, budget_.weights) &&
        !same_conditions(baseline_->timing, asset_->rating.timing))
      return add_reason(result_,
                        fmt::format("{}: the baseline's rendering times are of another device or size",
                                    info(limit.quantity).key),
                        place(mesh));
    ++result_.checked;
    if (before && !is_worse(limit.quantity, budget_.weights, limit.bound, *value.number, *before)) {
      ++result_.tolerated;
      return;
    }
    note(limit, mesh, others, *value.number, before);
  }

  void note(const Limit& limit, std::optional<std::size_t> mesh, std::uint64_t others, double value,
            std::optional<double> before) {
    Finding finding;
    finding.rule = index_;
    finding.severity = rule_.severity;
    finding.limit = limit;
    finding.value = value;
    finding.baseline = before;
    finding.asset = asset_index_;
    finding.mesh = mesh;
    finding.others = others;
    finding.number = result_.findings++;
    finding.path = asset_->path;
    if (mesh) {
      finding.node = instance_of(*asset_, *mesh).node;
      finding.name = instance_of(*asset_, *mesh).mesh;
    }
    worst_.add(finding);
    all_.add(finding);
  }

  std::string why_no_time(Quantity quantity) const {
    if (options_.allow_cpu_timing || !is_timed(quantity, budget_.weights)) return {};
    const auto& timing = asset_->rating.timing;
    const bool is_cpu = timing && timing->device.type == "cpu";
    if (!is_cpu && options_.cpu_device.empty()) return {};
    return fmt::format(
        "rendering times of a CPU device ({}) say nothing about a GPU; --allow-cpu-timing checks them "
        "nevertheless",
        is_cpu ? timing->device.name : options_.cpu_device);
  }

  std::optional<double> baseline_value(Quantity quantity, std::optional<std::size_t> mesh) const {
    if (baseline_ == nullptr) return std::nullopt;
    if (!mesh) return baseline_->values[index_of(quantity)];
    const std::optional<std::size_t> same = matches_[*mesh];
    return same ? baseline_->meshes[*same].values[index_of(quantity)] : std::nullopt;
  }

  std::string place(std::optional<std::size_t> mesh) const {
    if (!mesh) return asset_->path;
    const analysis::InstanceAnalysis& instance = instance_of(*asset_, *mesh);
    return place_text(asset_->path, instance.node, instance.mesh);
  }

  const Budget& budget_;
  const Rule& rule_;
  const std::size_t index_;
  const CheckOptions& options_;
  Worst<Finding>& all_;
  Worst<Finding> worst_{kMostFindingsPerRule};
  RuleResult result_;
  std::uint64_t analysed_ = 0;  // of result_.assets
  // The asset at hand.
  const AssetState* asset_ = nullptr;
  std::size_t asset_index_ = 0;
  const AssetBaseline* baseline_ = nullptr;
  std::span<const std::optional<std::size_t>> matches_;
};

void add_up(const Budget& budget, const CheckOptions& options, CheckResult& result) {
  for (std::size_t i = 0; i < result.rules.size(); ++i) {
    const RuleResult& rule = result.rules[i];
    const bool is_error = budget.rules[i].severity == Severity::kError;
    (is_error ? result.errors : result.warnings) += rule.findings;
    result.tolerated += rule.tolerated;
    result.checked += rule.checked;
    result.unchecked += rule.unchecked;
    ++result.verdicts[static_cast<std::size_t>(rule.verdict)];
    const bool strictly = options.strict && rule.unchecked > 0;
    if (is_error && (rule.findings > 0 || strictly)) result.failed = true;
  }
}

}  // namespace

double Finding::ratio() const {
  const double beyond = std::abs(value - limit.value);
  if (limit.value == 0) return std::numeric_limits<double>::infinity();
  return 1 + beyond / std::abs(limit.value);
}

bool operator<(const Finding& a, const Finding& b) {
  const auto key = [](const Finding& one) {
    // Of those without a ratio, which have a limit of 0, the larger value is the worse one.
    return std::tuple(one.severity, -one.ratio(), -std::abs(one.value), one.rule, one.number);
  };
  return key(a) < key(b);
}

CheckResult evaluate(const Budget& budget, std::span<const AssetState> assets, const CheckOptions& options) {
  Worst<Finding> worst(kMostFindings);
  std::vector<RuleCheck> checks;
  checks.reserve(budget.rules.size());
  for (std::size_t i = 0; i < budget.rules.size(); ++i) checks.emplace_back(budget, i, options, worst);
  CheckResult result;
  for (std::size_t i = 0; i < assets.size(); ++i) {
    const AssetBaseline* baseline = nullptr;
    std::vector<std::optional<std::size_t>> matches;
    if (options.baselines != nullptr && assets[i].failure.empty()) {
      const auto known = options.baselines->find(assets[i].path);
      if (known == options.baselines->end())
        ++result.new_assets;
      else
        baseline = &known->second, matches = match_meshes(assets[i], *baseline);
    }
    for (RuleCheck& check : checks) check.add(assets[i], i, baseline, matches);
  }
  for (RuleCheck& check : checks) result.rules.push_back(check.take(assets.size()));
  result.worst = worst.take();
  add_up(budget, options, result);
  return result;
}

std::string place_text(const std::string& path, const std::string& node, const std::string& mesh) {
  const std::string& name = node.empty() ? mesh : node;
  return fmt::format("{}: {}", path, name.empty() ? "(unnamed)" : name);
}

}  // namespace scene_analyzer::gate
