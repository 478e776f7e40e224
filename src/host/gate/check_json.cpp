// check_json.cpp — The verdict as JSON, described by docs/schema/check-v1.schema.json.
#include <cmath>

#include "base/version.h"
#include "gate/finding_text.h"
#include "report/document.h"

namespace scene_analyzer::gate {
namespace {

using nlohmann::ordered_json;

ordered_json number(Quantity quantity, double value) {
  if (!std::isfinite(value)) return nullptr;
  if (info(quantity).whole) return static_cast<std::uint64_t>(value);
  return value + 0.0;  // -0 + 0 = 0
}

ordered_json text_or_null(const std::string& text) {
  return text.empty() ? ordered_json() : ordered_json(text);
}

ordered_json counts(const CheckReport& report) {
  const CheckResult& result = report.result;
  return {{"rules", result.rules.size()},
          {"passed", result.verdicts[static_cast<std::size_t>(Verdict::kPass)]},
          {"failed", result.verdicts[static_cast<std::size_t>(Verdict::kFail)]},
          {"unchecked", result.verdicts[static_cast<std::size_t>(Verdict::kUnchecked)]},
          {"errors", result.errors},
          {"warnings", result.warnings},
          {"tolerated", result.tolerated},
          {"values_checked", result.checked},
          {"values_unchecked", result.unchecked},
          {"assets", report.assets.size()},
          {"assets_not_analysed", count_failures(report)},
          {"new_assets", result.new_assets}};
}

ordered_json limits(const Rule& rule) {
  ordered_json list = ordered_json::array();
  for (const Limit& limit : rule.limits)
    list.push_back({{"quantity", info(limit.quantity).key},
                    {"bound", key_of(limit.bound)},
                    {"limit", number(limit.quantity, limit.value)}});
  return list;
}

ordered_json rule_of(const Rule& rule, const RuleResult& result) {
  ordered_json reasons = ordered_json::array();
  for (const Reason& reason : result.reasons)
    reasons.push_back(
        {{"reason", reason.text}, {"count", reason.count}, {"example", text_or_null(reason.example)}});
  return {{"name", rule.name},
          {"line", rule.line},
          {"severity", key_of(rule.severity)},
          {"asset_globs", rule.assets},
          {"mesh_globs", rule.meshes},
          {"limits", limits(rule)},
          {"verdict", kVerdictKeys[static_cast<std::size_t>(result.verdict)]},
          {"assets", result.assets},
          {"meshes", result.meshes},
          {"checked", result.checked},
          {"findings", result.findings},
          {"tolerated", result.tolerated},
          {"unchecked", result.unchecked},
          {"reasons", std::move(reasons)}};
}

ordered_json finding_of(const CheckReport& report, const Finding& finding) {
  const Quantity quantity = finding.limit.quantity;
  const double ratio = finding.ratio();
  return {{"rule", report.budget.rules[finding.rule].name},
          {"severity", key_of(finding.severity)},
          {"asset", finding.path},
          {"node", finding.mesh ? ordered_json(finding.node) : ordered_json()},
          {"mesh", finding.mesh ? ordered_json(finding.name) : ordered_json()},
          {"index", finding.mesh ? ordered_json(*finding.mesh) : ordered_json()},
          {"others", finding.others},
          {"quantity", info(quantity).key},
          {"bound", key_of(finding.limit.bound)},
          {"value", number(quantity, finding.value)},
          {"limit", number(quantity, finding.limit.value)},
          {"ratio", std::isfinite(ratio) ? ordered_json(ratio) : ordered_json()},
          {"baseline", finding.baseline ? number(quantity, *finding.baseline) : ordered_json()},
          {"what_to_do", what_to_do(quantity, finding.limit.bound)}};
}

}  // namespace

std::string check_json(const CheckReport& report) {
  ordered_json rules = ordered_json::array(), findings = ordered_json::array(),
               failures = ordered_json::array();
  for (std::size_t i = 0; i < report.budget.rules.size(); ++i)
    rules.push_back(rule_of(report.budget.rules[i], report.result.rules[i]));
  for (const Finding& finding : report.result.worst) findings.push_back(finding_of(report, finding));
  for (const AssetState& asset : report.assets)
    if (!asset.failure.empty()) failures.push_back({{"asset", asset.path}, {"reason", asset.failure}});
  const ordered_json document = {{"schema_version", 1},
                                 {"tool", {{"version", version()}}},
                                 {"budget", report.budget.file},
                                 {"baseline", text_or_null(report.baseline)},
                                 {"strict", report.strict},
                                 {"verdict", report.result.failed ? "fail" : "pass"},
                                 {"counts", counts(report)},
                                 {"rules", std::move(rules)},
                                 {"findings", std::move(findings)},
                                 {"assets_not_analysed", std::move(failures)}};
  return report::print(document, 2) + '\n';
}

}  // namespace scene_analyzer::gate
