#include "gate/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "base/error.h"
#include "files/file.h"
#include "library/asset_list.h"

namespace scene_analyzer::gate {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  try {
    files::File file = files::File::open_regular(path);
    // One byte more tells a file that is too large, and one that grows.
    std::string text(kMostBudgetBytes + 1, '\0');
    text.resize(file.read(text));
    return text;
  } catch (const std::system_error& error) {
    throw UsageError(
        fmt::format("--budget: {}: cannot be read: {}", path.string(),
                    error.code() == std::errc::is_a_directory ? "it is a folder" : error.code().message()));
  }
}

}  // namespace

Budget read_budget(const fs::path& file) {
  return parse_budget(text_of(file), file.string());
}

bool is_timed(Quantity quantity, const Weights& weights) {
  const auto metric = analysis::Metric::kRenderingTime;
  return quantity == Quantity::kRenderingTime || quantity == quantity_of(metric) ||
         (quantity == Quantity::kAggregate && weights[index_of(metric)] > 0);
}

analysis::MetricSet needed_metrics(const Budget& budget) {
  analysis::MetricSet metrics;
  for (const Rule& rule : budget.rules)
    for (const Limit& limit : rule.limits) {
      if (const auto metric = rated_metric(limit.quantity)) metrics.set(index_of(*metric));
      if (is_timed(limit.quantity, budget.weights)) metrics.set(index_of(analysis::Metric::kRenderingTime));
      if (limit.quantity != Quantity::kAggregate) continue;
      for (std::size_t i = 0; i < metrics.size(); ++i)
        if (budget.weights[i] > 0) metrics.set(i);
    }
  return metrics;
}

bool applies_to_asset(const Rule& rule, const std::string& path) {
  return rule.assets.empty() || std::ranges::any_of(rule.assets, [&](const std::string& glob) {
           const bool whole = glob.find('/') != std::string::npos;
           return library::matches(whole ? path : fs::path(path).filename().string(), glob);
         });
}

bool applies_to_mesh(const Rule& rule, const std::string& node, const std::string& mesh) {
  return rule.meshes.empty() || std::ranges::any_of(rule.meshes, [&](const std::string& glob) {
           return library::matches(node, glob) || library::matches(mesh, glob);
         });
}

}  // namespace scene_analyzer::gate
