// outputs.h — A verdict as table, JSON, JUnit XML, SARIF 2.1.0 and GitHub annotations.
//
// Names from assets and budgets are untrusted: each output escapes them by its own rules. Listings are capped
// (evaluate.h), and say how many there are in all.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "gate/evaluate.h"
#include "report/report.h"

namespace scene_analyzer::gate {

struct CheckReport {
  const Budget& budget;
  std::span<const AssetState> assets;
  const CheckResult& result;
  std::string baseline = {};  // folder; or empty
  bool strict = false;
};

inline constexpr std::size_t kMostTableRows = 50, kMostAnnotations = 10;

std::string check_table(const CheckReport& report, const report::TableStyle& style);
// UTF-8, two-space indent; docs/schema/check-v1.schema.json.
std::string check_json(const CheckReport& report);
// A test case per rule and per asset that could not be analysed. Warnings are a case's system-out.
std::string check_junit(const CheckReport& report);
// A result per finding that is listed; what was not checked is a notification of the run.
std::string check_sarif(const CheckReport& report);
// Workflow commands, one per line: the worst findings, assets that could not be analysed, rules that are
// unchecked, and the count of the rest.
std::string github_annotations(const CheckReport& report);

// "gate failed: 2 of 5 rules fail (3 errors, 1 warning), 1 unchecked"
std::string summary(const CheckReport& report);

}  // namespace scene_analyzer::gate
