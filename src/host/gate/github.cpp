// github.cpp — Annotations as workflow commands of GitHub Actions: ::error file=...,title=...::message
#include <fmt/format.h>

#include <algorithm>

#include "gate/finding_text.h"
#include "report/mesh_names.h"
#include "report/terminal_text.h"

namespace scene_analyzer::gate {
namespace {

// What the runner takes apart is written as %XX: in values of properties also what separates them.
std::string escaped(const std::string& text, bool is_property) {
  std::string result;
  for (const char c : text)
    if (c == '%' || c == '\r' || c == '\n' || (is_property && (c == ':' || c == ',')))
      result += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    else
      result += c;
  return result;
}

std::string command(std::string_view level, const std::string& file, const std::string& title,
                    const std::string& message) {
  const std::string place = file.empty() ? "" : fmt::format("file={},", escaped(file, true));
  return fmt::format("::{} {}title={}::{}\n", level, place, escaped(title, true), escaped(message, false));
}

// What nothing of failed, but was not checked either.
std::string unchecked_rules(const CheckReport& report) {
  std::string text;
  std::size_t shown = 0;
  for (std::size_t i = 0; i < report.result.rules.size(); ++i) {
    const Rule& rule = report.budget.rules[i];
    const RuleResult& result = report.result.rules[i];
    if (result.verdict != Verdict::kUnchecked || result.reasons.empty() || ++shown > kMostAnnotations)
      continue;
    const bool fails = report.strict && rule.severity == Severity::kError;
    text += command(fails ? "error" : "warning", "", clean(rule.name),
                    fmt::format("not checked: {}", sentence(result.reasons.front())));
  }
  return text;
}

}  // namespace

std::string github_annotations(const CheckReport& report) {
  const report::UnicodeScope unicode;
  std::string text;
  // Every face of GitHub shows ten of a kind per step.
  std::size_t shown = 0;
  for (const Finding& finding : report.result.worst) {
    if (shown == kMostAnnotations) break;
    ++shown;
    text += command(key_of(finding.severity), clean(finding.path),
                    clean(report.budget.rules[finding.rule].name), sentence(finding));
  }
  std::size_t failures = 0;
  for (const AssetState& asset : report.assets)
    if (!asset.failure.empty() && ++failures <= kMostAnnotations)
      text += command("error", clean(asset.path), "could not be analysed", clean(asset.failure));
  text += unchecked_rules(report);
  const std::uint64_t all = report.result.errors + report.result.warnings;
  std::string rest = summary(report);
  if (all > shown)
    rest += fmt::format("; {} not shown", report::plural(all - shown, "finding is", "findings are"));
  if (failures > kMostAnnotations) rest += fmt::format("; {} assets not shown", failures - kMostAnnotations);
  return text + command("notice", "", "scene-analyzer check", rest);
}

}  // namespace scene_analyzer::gate
