#include "gate/finding_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/mesh_names.h"
#include "report/terminal_text.h"

namespace scene_analyzer::gate {

using report::plural;

std::string clean(const std::string& text) {
  return report::encode_utf8(report::printable(text));
}

std::string place_of(const Finding& finding) {
  if (!finding.mesh) return clean(finding.path);
  std::string text = clean(place_text(finding.path, finding.node, finding.name));
  if (finding.others > 0) text += fmt::format(" (and {} more)", finding.others);
  return text;
}

std::string excess_of(const Finding& finding) {
  const Quantity quantity = finding.limit.quantity;
  std::string text =
      fmt::format("{} {}, limit {} {}", info(quantity).key, value_text(quantity, finding.value),
                  key_of(finding.limit.bound), value_text(quantity, finding.limit.value));
  if (finding.limit.bound == Bound::kMost && finding.limit.value > 0)
    text += finding.ratio() < 100 ? fmt::format(" ({:.3g} times)", finding.ratio())
                                  : fmt::format(" ({:.0f} times)", finding.ratio());
  if (finding.baseline) text += fmt::format("; the baseline has {}", value_text(quantity, *finding.baseline));
  return text;
}

std::string sentence(const Finding& finding) {
  return fmt::format("{}: {}. What to do: {}", place_of(finding), excess_of(finding),
                     what_to_do(finding.limit.quantity, finding.limit.bound));
}

std::string sentence(const Reason& reason) {
  std::string text = clean(reason.text);
  if (reason.count > 1) text = fmt::format("{} times: {}", reason.count, text);
  if (!reason.example.empty()) text += (reason.count > 1 ? " (first " : " (") + clean(reason.example) + ')';
  return text;
}

std::uint64_t count_failures(const CheckReport& report) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(report.assets, [](const AssetState& asset) { return !asset.failure.empty(); }));
}

std::string summary(const CheckReport& report) {
  const CheckResult& result = report.result;
  const auto rules = [&](Verdict verdict) { return result.verdicts[static_cast<std::size_t>(verdict)]; };
  std::string text = fmt::format("gate {}: {} of {} pass", result.failed ? "failed" : "passed",
                                 rules(Verdict::kPass), plural(result.rules.size(), "rule", "rules"));
  if (rules(Verdict::kFail) > 0)
    text +=
        fmt::format(", {} {} ({}, {})", rules(Verdict::kFail), rules(Verdict::kFail) == 1 ? "fails" : "fail",
                    plural(result.errors, "error", "errors"), plural(result.warnings, "warning", "warnings"));
  if (rules(Verdict::kUnchecked) > 0) text += fmt::format(", {} unchecked", rules(Verdict::kUnchecked));
  if (result.tolerated > 0)
    text += fmt::format("; {} beyond a limit, no worse than the baseline",
                        plural(result.tolerated, "value", "values"));
  if (const std::uint64_t failures = count_failures(report); failures > 0)
    text += fmt::format("; {} could not be analysed", plural(failures, "asset", "assets"));
  return text;
}

}  // namespace scene_analyzer::gate
