// table.cpp — The verdict for people: rules, the worst findings, one line that says it all.
#include <fmt/format.h>

#include <algorithm>

#include "gate/finding_text.h"
#include "report/mesh_names.h"
#include "report/terminal_text.h"

namespace scene_analyzer::gate {
namespace {

using report::plural;

constexpr std::size_t kLeastWidth = 60, kDefaultWidth = 120, kMostRuleWidth = 40;
constexpr std::size_t kMostRulesShown = 200;  // those that pass are left out first

std::string fit(const std::string& text, std::size_t width) {
  return report::encode_utf8(report::shortened(report::printable(text), width));
}

std::size_t rule_width(const CheckReport& report) {
  std::size_t widest = 4;
  for (const Rule& rule : report.budget.rules)
    widest = std::max(widest, report::columns(report::printable(rule.name)));
  return std::min(widest, kMostRuleWidth);
}

std::string_view mark(Verdict verdict) {
  return verdict == Verdict::kFail ? "FAIL" : kVerdictKeys[static_cast<std::size_t>(verdict)];
}

std::string rule_row(const Rule& rule, const RuleResult& result, std::size_t width) {
  return fmt::format("{:<9}  {}  {:<8}  {:>8}  {:>8}  {:>9}\n", mark(result.verdict),
                     report::padded_name(report::printable(rule.name), width), key_of(rule.severity),
                     result.checked, result.findings, result.unchecked);
}

std::string rule_rows(const CheckReport& report) {
  const std::size_t width = rule_width(report);
  std::string text =
      fmt::format("{:<9}  {}  {:<8}  {:>8}  {:>8}  {:>9}\n", "verdict", report::padded_name(U"rule", width),
                  "severity", "checked", "findings", "unchecked");
  const auto& rules = report.result.rules;
  std::size_t shown = 0;
  for (const Verdict verdict : {Verdict::kFail, Verdict::kUnchecked, Verdict::kPass})
    for (std::size_t i = 0; i < rules.size(); ++i)
      if (rules[i].verdict == verdict && ++shown <= kMostRulesShown)
        text += rule_row(report.budget.rules[i], rules[i], width);
  if (shown > kMostRulesShown) text += fmt::format("... and {} more rules\n", shown - kMostRulesShown);
  return text;
}

// Why something was not checked, once per rule and reason.
std::string reasons(const CheckReport& report, std::size_t width) {
  std::string text;
  std::size_t lines = 0;
  for (std::size_t i = 0; i < report.result.rules.size(); ++i)
    for (const Reason& reason : report.result.rules[i].reasons)
      if (++lines <= kMostTableRows)
        text += "  " + fit(fmt::format("{}: {}", report.budget.rules[i].name, sentence(reason)), width - 2) +
                '\n';
  if (lines > kMostTableRows) text += fmt::format("  ... and {} more\n", lines - kMostTableRows);
  return text.empty() ? text : "\nnot checked:\n" + text;
}

std::string failures(const CheckReport& report, std::size_t width) {
  std::string text;
  std::size_t lines = 0;
  for (const AssetState& asset : report.assets)
    if (!asset.failure.empty() && ++lines <= kMostTableRows)
      text += "  " + fit(fmt::format("{}: {}", asset.path, asset.failure), width - 2) + '\n';
  if (lines > kMostTableRows) text += fmt::format("  ... and {} more\n", lines - kMostTableRows);
  return text.empty() ? text : "\ncould not be analysed:\n" + text;
}

std::string findings(const CheckReport& report, std::size_t width) {
  const auto& worst = report.result.worst;
  if (worst.empty()) return "";
  std::string text = "\nfindings, the farthest beyond their limits first:\n";
  for (std::size_t i = 0; i < std::min(worst.size(), kMostTableRows); ++i) {
    const Finding& one = worst[i];
    text += "  " +
            fit(fmt::format("{}: {}: {}", key_of(one.severity), report.budget.rules[one.rule].name,
                            place_of(one)),
                width - 2) +
            '\n';
    text += "    " +
            fit(fmt::format("{}: {}", excess_of(one), what_to_do(one.limit.quantity, one.limit.bound)),
                width - 4) +
            '\n';
  }
  const std::uint64_t all = report.result.errors + report.result.warnings;
  if (all > kMostTableRows)
    text += fmt::format("  ... and {}\n", plural(all - kMostTableRows, "more finding", "more findings"));
  return text;
}

}  // namespace

std::string check_table(const CheckReport& report, const report::TableStyle& style) {
  const report::UnicodeScope unicode;
  // Sentences are cut where a terminal ends, and whole in files and logs.
  const std::size_t width = style.width == 0 ? kDefaultWidth * 8 : std::max(kLeastWidth, style.width);
  return rule_rows(report) + failures(report, width) + reasons(report, width) + findings(report, width) +
         '\n' + summary(report) + '\n';
}

}  // namespace scene_analyzer::gate
