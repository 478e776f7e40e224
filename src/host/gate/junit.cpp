// junit.cpp — JUnit XML as Jenkins, GitLab and others read it: the elements and attributes of the JUnit
// schema of Jenkins' xUnit plugin (junit-10.xsd), and no others.
#include <fmt/format.h>

#include <algorithm>

#include "gate/finding_text.h"
#include "report/mesh_names.h"
#include "report/terminal_text.h"

namespace scene_analyzer::gate {
namespace {

// For attributes and for text. What is no character of XML 1.0 is none of `clean` text either, but for those
// that end a plane.
std::string xml(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&apos;";
        break;
      default:
        result += c;
    }
  return result;
}

struct Case {
  std::string folder, name, content;
  enum { kPassed, kFailed, kSkipped, kError } state = kPassed;
};

std::string listed(const RuleResult& result) {
  std::string text;
  for (const Finding& finding : result.worst) text += sentence(finding) + '\n';
  if (result.findings > result.worst.size())
    text += fmt::format("... and {}\n", report::plural(result.findings - result.worst.size(), "more finding",
                                                       "more findings"));
  for (const Reason& reason : result.reasons) text += "not checked: " + sentence(reason) + '\n';
  return text;
}

std::string element(const char* name, const std::string& message, const std::string& type,
                    const std::string& text) {
  return fmt::format("      <{0} message=\"{1}\" type=\"{2}\">{3}</{0}>\n", name, xml(message), type,
                     xml(text));
}

Case case_of(const CheckReport& report, std::size_t index) {
  const Rule& rule = report.budget.rules[index];
  const RuleResult& result = report.result.rules[index];
  Case one{"scene-analyzer.rules", clean(rule.name), "", Case::kPassed};
  const bool is_error = rule.severity == Severity::kError;
  const std::string found = report::plural(result.findings, "finding", "findings");
  if (result.verdict == Verdict::kFail && is_error) {
    one.state = Case::kFailed;
    one.content = element("failure", found, "beyond-limit", listed(result));
  } else if (is_error && report.strict && result.unchecked > 0) {
    one.state = Case::kFailed;
    one.content = element("failure", "not checked, which --strict fails", "unchecked", listed(result));
  } else if (result.verdict == Verdict::kUnchecked) {
    one.state = Case::kSkipped;
    const std::string why = result.reasons.empty() ? "nothing was checked" : sentence(result.reasons.front());
    one.content = fmt::format("      <skipped message=\"{}\"/>\n", xml(why));
  } else if (result.verdict == Verdict::kFail) {
    one.content =
        fmt::format("      <system-out>{}</system-out>\n", xml("warning: " + found + '\n' + listed(result)));
  }
  return one;
}

}  // namespace

std::string check_junit(const CheckReport& report) {
  const report::UnicodeScope unicode;
  std::vector<Case> cases;
  for (std::size_t i = 0; i < report.budget.rules.size(); ++i) cases.push_back(case_of(report, i));
  for (const AssetState& asset : report.assets)
    if (!asset.failure.empty())
      cases.push_back({"scene-analyzer.assets", clean(asset.path),
                       element("error", "could not be analysed", "asset", clean(asset.failure)),
                       Case::kError});
  const auto count = [&](auto state) {
    return std::ranges::count_if(cases, [&](const Case& one) { return one.state == state; });
  };
  const std::string totals = fmt::format("name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\"",
                                         xml("scene-analyzer check " + clean(report.budget.file)),
                                         cases.size(), count(Case::kFailed), count(Case::kError));
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  text += fmt::format("<testsuites {}>\n  <testsuite {} skipped=\"{}\">\n", totals, totals,
                      count(Case::kSkipped));
  for (const Case& one : cases) {
    text += fmt::format("    <testcase classname=\"{}\" name=\"{}\"", one.folder, xml(one.name));
    text += one.content.empty() ? "/>\n" : ">\n" + one.content + "    </testcase>\n";
  }
  return text + "  </testsuite>\n</testsuites>\n";
}

}  // namespace scene_analyzer::gate
