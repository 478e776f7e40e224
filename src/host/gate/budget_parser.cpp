// budget_parser.cpp — TOML -> Budget. toml++ is included here and nowhere else.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/byte_text.h"
#include "base/error.h"
#include "base/nearest.h"
#include "gate/budget.h"

namespace scene_analyzer::gate {
namespace {

// A key of many parts becomes as many tables within each other, and the parser goes down them by recursion.
constexpr std::ptrdiff_t kMostDotsPerLine = 1000;
constexpr std::size_t kMostShown = 60;  // bytes of the budget's text in a message

using Names = std::vector<std::string>;

std::string shown(std::string_view text) {
  return text.size() <= kMostShown ? std::string(text) : std::string(text.substr(0, kMostShown)) + "...";
}

std::string suggestion(std::string_view key, std::span<const std::string> known) {
  const std::string meant = key.size() > kLongestText ? "" : nearest(key, known);
  return meant.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                       : fmt::format("did you mean {}?", meant);
}

class BudgetParser {
 public:
  explicit BudgetParser(const std::string& file) : file_(file) { budget_.file = file; }

  Budget parse(std::string_view text) {
    check_size(text);
    try {
      // The parser's own name for the source would be part of every node.
      read_root(toml::parse(text));
    } catch (const toml::parse_error& error) {
      fail(error.source().begin, fmt::format("is no TOML: {}", error.description()));
    }
    return std::move(budget_);
  }

 private:
  [[noreturn]] void fail(const toml::source_position& place, const std::string& what) const {
    throw UsageError(fmt::format("{}:{}:{}: {}", file_, std::max<std::size_t>(place.line, 1),
                                 std::max<std::size_t>(place.column, 1), what));
  }
  [[noreturn]] void fail(const toml::node& node, const std::string& what) const {
    fail(node.source().begin, what);
  }
  [[noreturn]] void fail(const toml::key& key, const std::string& what) const {
    fail(key.source().begin, what);
  }
  [[noreturn]] void fail_type(const toml::node& node, std::string_view key, std::string_view wanted) const {
    fail(node, fmt::format("{} has to be {}", key, wanted));
  }

  void check_size(std::string_view text) const {
    if (text.size() > kMostBudgetBytes)
      throw UsageError(
          fmt::format("{}: is larger than {} MiB; is it a budget?", file_, kMostBudgetBytes >> 20));
    std::uint32_t line = 1;
    for (std::size_t begin = 0; begin < text.size(); ++line) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      if (std::count(text.begin() + static_cast<std::ptrdiff_t>(begin),
                     text.begin() + static_cast<std::ptrdiff_t>(end), '.') > kMostDotsPerLine)
        fail({line, 1},
             fmt::format("a line with more than {} dots; break it into several", kMostDotsPerLine));
      begin = end + 1;
    }
  }

  void check_key(const toml::key& key, const Names& known, std::string_view where) const {
    if (std::ranges::find(known, key.str()) != known.end()) return;
    fail(key, fmt::format("unknown key '{}'{}; {}", shown(key.str()), where, suggestion(key.str(), known)));
  }

  void read_root(const toml::table& root) {
    static const Names kKnown = {"version", "eye", "weights", "rule"};
    for (const auto& [key, node] : root) check_key(key, kKnown, "");
    read_version(root);
    if (const toml::node* eye = root.get("eye")) budget_.eye = read_point(*eye);
    if (const toml::node* weights = root.get("weights")) read_weights(*weights);
    const toml::node* rules = root.get("rule");
    if (rules == nullptr)
      fail(toml::source_position{1, 1},
           "has no rule; write [[rule]] with a name and limits such as max.triangles = 5000");
    const toml::array* list = rules->as_array();
    if (list == nullptr || !list->is_homogeneous<toml::table>())
      fail_type(*rules, "rule", "a list of tables; write [[rule]], with two brackets, before each rule");
    if (list->size() > kMostRules)
      fail(*rules, fmt::format("more than {} rules; globs let one rule serve many assets", kMostRules));
    for (const toml::node& rule : *list) budget_.rules.push_back(read_rule(*rule.as_table()));
  }

  void read_version(const toml::table& root) const {
    const toml::node* version = root.get("version");
    if (version == nullptr)
      fail(toml::source_position{1, 1}, "has no version; write version = 1 at its beginning");
    const auto* number = version->as_integer();
    if (number == nullptr) fail_type(*version, "version", "the whole number 1");
    if (number->get() != 1)
      fail(*version, fmt::format("version {} is not known to this program, which reads version 1; a newer "
                                 "scene-analyzer may read it",
                                 number->get()));
  }

  // A finite number.
  double read_number(const toml::node& node, std::string_view key) const {
    double value = NAN;
    if (const auto* integer = node.as_integer())
      value = static_cast<double>(integer->get());
    else if (const auto* number = node.as_floating_point())
      value = number->get();
    else
      fail_type(node, key, "a number");
    if (!std::isfinite(value)) fail_type(node, key, "a finite number");
    return value;
  }

  mesh::Vector3 read_point(const toml::node& node) const {
    mesh::Vector3 point{};
    const toml::array* list = node.as_array();
    if (list == nullptr || list->size() != point.size())
      fail_type(node, "eye", "three numbers, such as [0, 1.7, 2]");
    for (std::size_t i = 0; i < point.size(); ++i) point[i] = read_number(*list->get(i), "eye");
    return point;
  }

  void read_weights(const toml::node& node) {
    static const Names kKnown(analysis::kMetricKeys.begin(), analysis::kMetricKeys.end());
    const toml::table* table = node.as_table();
    if (table == nullptr) fail_type(node, "weights", "a table: [weights]");
    budget_.weights = {};
    for (const auto& [key, weight] : *table) {
      check_key(key, kKnown, " in weights");
      const double value = read_number(weight, key.str());
      if (value < 0 || value > 1e6)
        fail(weight, fmt::format("the weight of {} has to lie in [0, 1e6]", key.str()));
      budget_.weights[index_of(*analysis::metric_of(key.str()))] = value;
    }
    if (std::ranges::none_of(budget_.weights, [](double weight) { return weight > 0; }))
      fail(node, "no metric has a weight above 0; at least one is needed");
  }

  Rule read_rule(const toml::table& table) {
    static const Names kKnown = {"name", "assets", "meshes", "severity", "max", "min"};
    for (const auto& [key, node] : table) check_key(key, kKnown, " in a rule");
    Rule rule;
    rule.line = table.source().begin.line;
    const toml::node* name = table.get("name");
    if (name == nullptr) fail(table, "a rule without a name; write name = \"what it is about\"");
    rule.name = read_text(*name, "name");
    if (std::ranges::any_of(rule.name, [](unsigned char c) { return c < 0x20 || c == 0x7F; }))
      fail_type(*name, "name", "a text of one line without control characters");
    if (!names_.insert(rule.name).second)
      fail(*name,
           fmt::format("there is another rule named '{}'; each needs a name of its own", shown(rule.name)));
    if (const toml::node* globs = table.get("assets")) rule.assets = read_globs(*globs, "assets");
    if (const toml::node* globs = table.get("meshes")) rule.meshes = read_globs(*globs, "meshes");
    if (const toml::node* severity = table.get("severity")) rule.severity = read_severity(*severity);
    for (const Bound bound : {Bound::kMost, Bound::kLeast})
      if (const toml::node* limits = table.get(key_of(bound))) read_limits(*limits, bound, "", rule);
    if (rule.limits.empty())
      fail(table,
           fmt::format("rule '{}' has no limit; write for example max.triangles = 5000", shown(rule.name)));
    check_order(table, rule);
    return rule;
  }

  std::string read_text(const toml::node& node, std::string_view key) const {
    const auto* text = node.as_string();
    if (text == nullptr) fail_type(node, key, "a text in quotes");
    if (text->get().empty() || text->get().size() > kLongestText)
      fail_type(node, key, fmt::format("a text of 1 to {} bytes", kLongestText));
    if (text->get().find('\0') != std::string::npos) fail_type(node, key, "a text without \\u0000");
    return text->get();
  }

  std::vector<std::string> read_globs(const toml::node& node, std::string_view key) const {
    const toml::array* list = node.as_array();
    if (list == nullptr) {
      if (!node.is_string()) fail_type(node, key, "a glob such as \"props/*\", or a list of them");
      return {read_text(node, key)};
    }
    if (list->empty() || list->size() > kMostGlobs)
      fail_type(node, key, fmt::format("1 to {} globs; without the key a rule is for all", kMostGlobs));
    std::vector<std::string> globs;
    for (const toml::node& glob : *list) globs.push_back(read_text(glob, key));
    return globs;
  }

  Severity read_severity(const toml::node& node) const {
    static const Names kKnown = {"error", "warning"};
    const std::string text = read_text(node, "severity");
    if (text == "error") return Severity::kError;
    if (text == "warning") return Severity::kWarning;
    fail(node, fmt::format("severity '{}' is unknown; {}", shown(text), suggestion(text, kKnown)));
  }

  void read_limits(const toml::node& node, Bound bound, const std::string& prefix, Rule& rule) const {
    const toml::table* table = node.as_table();
    if (table == nullptr)
      fail_type(node, fmt::format("{}{}", key_of(bound), prefix.empty() ? "" : ".defects"),
                prefix.empty() ? "followed by what it limits, such as max.triangles = 5000"
                               : "followed by a kind or total, such as max.defects.total = 0");
    for (const auto& [key, value] : *table) {
      if (prefix.empty() && key.str() == "defects") {
        read_limits(value, bound, "defects.", rule);
        continue;
      }
      const std::string name = prefix + std::string(key.str());
      const auto quantity = quantity_of(name);
      if (!quantity)
        fail(key, fmt::format("unknown limit '{}.{}'; {}", key_of(bound), shown(name),
                              suggestion(name, quantity_keys())));
      for (const Limit& other : rule.limits)
        if (other.quantity == *quantity && other.bound == bound)
          fail(key, fmt::format("{}.{} is limited twice in this rule", key_of(bound), name));
      rule.limits.push_back({*quantity, bound, read_limit(value, *quantity, bound)});
    }
  }

  double read_limit(const toml::node& node, Quantity quantity, Bound bound) const {
    const QuantityInfo& about = info(quantity);
    const std::string key = fmt::format("{}.{}", key_of(bound), about.key);
    if (quantity == Quantity::kFileBytes && node.is_string()) {
      const auto bytes = bytes_of(node.as_string()->get());
      if (!bytes) fail_type(node, key, fmt::format("bytes, or {}", kByteExamples));
      return static_cast<double>(*bytes);
    }
    const double value = read_number(node, key);
    if (value < about.least || value > about.greatest)
      fail(node,
           fmt::format("{} is {}, but its values lie in [{}, {}]: this limit would never or always hold", key,
                       value, about.least, about.greatest));
    if (about.whole && value != std::floor(value)) fail_type(node, key, "a whole number");
    return value;
  }

  void check_order(const toml::table& table, const Rule& rule) const {
    for (const Limit& most : rule.limits)
      for (const Limit& least : rule.limits)
        if (most.quantity == least.quantity && most.bound == Bound::kMost && least.bound == Bound::kLeast &&
            least.value > most.value)
          fail(table, fmt::format("rule '{}': min.{} is larger than max.{}; nothing can pass",
                                  shown(rule.name), info(most.quantity).key, info(most.quantity).key));
  }

  const std::string& file_;
  std::set<std::string> names_;
  Budget budget_;
};

}  // namespace

Budget parse_budget(std::string_view text, const std::string& file) {
  return BudgetParser(file).parse(text);
}

}  // namespace scene_analyzer::gate
