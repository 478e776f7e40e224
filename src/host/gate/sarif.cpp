// sarif.cpp — SARIF 2.1.0 (OASIS), as far as GitHub's code scanning reads it.
#include <fmt/format.h>
#include <xxhash.h>

#include "base/version.h"
#include "gate/finding_text.h"
#include "report/document.h"
#include "report/terminal_text.h"

namespace scene_analyzer::gate {
namespace {

using nlohmann::ordered_json;

// RFC 3986: a relative reference's path, byte by byte. A first segment with a colon would be a scheme.
std::string uri_of(const std::string& path) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string uri;
  for (const char c : path)
    if (kPlain.find(c) != std::string_view::npos)
      uri += c;
    else
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return uri;
}

ordered_json message(const std::string& text) {
  return {{"text", text}};
}

// As it is: what is shown of two names may be the same.
const std::string& id_of(const Rule& rule) {
  return rule.name;
}

std::string level_of(Severity severity) {
  return severity == Severity::kError ? "error" : "warning";
}

ordered_json rules_of(const CheckReport& report) {
  ordered_json rules = ordered_json::array();
  for (const Rule& rule : report.budget.rules) {
    std::string limits;
    for (const Limit& limit : rule.limits)
      limits += fmt::format("{}{}.{} = {}", limits.empty() ? "" : ", ", key_of(limit.bound),
                            info(limit.quantity).key, value_text(limit.quantity, limit.value));
    rules.push_back(
        {{"id", id_of(rule)},
         {"shortDescription", message(clean(rule.name))},
         {"fullDescription", message(limits)},
         {"help", message(fmt::format("{}, line {}: {}", clean(report.budget.file), rule.line, limits))},
         {"defaultConfiguration", {{"level", level_of(rule.severity)}}}});
  }
  return rules;
}

// The same finding in a later run: whose, not how much.
std::string fingerprint(const CheckReport& report, const Finding& finding) {
  std::string text = report.budget.rules[finding.rule].name;
  for (const std::string_view part :
       {std::string_view(finding.path), std::string_view(finding.node), std::string_view(finding.name),
        info(finding.limit.quantity).key, key_of(finding.limit.bound)})
    text.append(1, '\0').append(part);
  return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()));
}

ordered_json location_of(const Finding& finding) {
  // GitHub shows nothing without a line, also of files that have none.
  ordered_json location = {
      {"physicalLocation",
       {{"artifactLocation", {{"uri", uri_of(finding.path)}, {"uriBaseId", "%SRCROOT%"}}},
        {"region", {{"startLine", 1}}}}}};
  if (!finding.mesh) return location;
  const std::string& name = finding.node.empty() ? finding.name : finding.node;
  location["logicalLocations"] = ordered_json::array(
      {{{"name", clean(name.empty() ? "(unnamed)" : name)},
        {"fullyQualifiedName", clean(place_text(finding.path, finding.node, finding.name))},
        {"kind", "object"}}});
  return location;
}

ordered_json result_of(const CheckReport& report, const Finding& finding) {
  const Quantity quantity = finding.limit.quantity;
  ordered_json properties = {{"quantity", info(quantity).key},
                             {"bound", key_of(finding.limit.bound)},
                             {"value", finding.value},
                             {"limit", finding.limit.value},
                             {"instances", finding.others + 1}};
  if (finding.baseline) properties["baseline"] = *finding.baseline;
  return {{"ruleId", id_of(report.budget.rules[finding.rule])},
          {"ruleIndex", finding.rule},
          {"level", level_of(finding.severity)},
          {"message", message(sentence(finding))},
          {"locations", ordered_json::array({location_of(finding)})},
          {"partialFingerprints", {{"findingOfMesh/v1", fingerprint(report, finding)}}},
          {"properties", std::move(properties)}};
}

ordered_json notification(const std::string& level, const std::string& text) {
  return {{"level", level}, {"message", message(text)}};
}

ordered_json notifications(const CheckReport& report) {
  ordered_json list = ordered_json::array();
  for (const AssetState& asset : report.assets)
    if (!asset.failure.empty())
      list.push_back(notification(
          "error", fmt::format("{} could not be analysed: {}", clean(asset.path), clean(asset.failure))));
  for (std::size_t i = 0; i < report.result.rules.size(); ++i)
    for (const Reason& reason : report.result.rules[i].reasons) {
      const bool fails = report.strict && report.budget.rules[i].severity == Severity::kError;
      ordered_json one =
          notification(fails ? "error" : "warning", fmt::format("not checked: {}", sentence(reason)));
      one["associatedRule"] = {{"id", id_of(report.budget.rules[i])}, {"index", i}};
      list.push_back(std::move(one));
    }
  const std::uint64_t all = report.result.errors + report.result.warnings;
  if (all > report.result.worst.size())
    list.push_back(notification("warning", fmt::format("{} of {} findings are listed, the worst ones",
                                                       report.result.worst.size(), all)));
  return list;
}

}  // namespace

std::string check_sarif(const CheckReport& report) {
  const report::UnicodeScope unicode;
  ordered_json results = ordered_json::array();
  for (const Finding& finding : report.result.worst) results.push_back(result_of(report, finding));
  ordered_json run;
  run["tool"] = {{"driver",
                  {{"name", "scene-analyzer"},
                   {"version", version()},
                   {"semanticVersion", version()},
                   {"rules", rules_of(report)}}}};
  run["originalUriBaseIds"] = {{"%SRCROOT%", {{"description", message("the folder that the check ran in")}}}};
  run["invocations"] = ordered_json::array({{{"executionSuccessful", count_failures(report) == 0},
                                             {"toolExecutionNotifications", notifications(report)}}});
  run["columnKind"] = "unicodeCodePoints";
  run["results"] = std::move(results);
  const ordered_json log = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                            {"version", "2.1.0"},
                            {"runs", ordered_json::array({std::move(run)})}};
  return report::print(log, 2) + '\n';
}

}  // namespace scene_analyzer::gate
