#include "reference/area_classes.h"

#include <algorithm>
#include <utility>

#include "reference/geometry.h"

namespace scene_analyzer::reference {
namespace {

constexpr double kSameArea = 1.19209e-07;

}  // namespace

AreaClasses distinct_areas(std::span<const double> areas, std::span<const std::uint8_t> kept) {
  std::vector<std::pair<double, std::uint32_t>> sorted;
  sorted.reserve(areas.size());
  for (std::uint32_t triangle = 0; triangle < areas.size(); ++triangle)
    if (kept[triangle]) sorted.emplace_back(areas[triangle], triangle);
  std::sort(sorted.begin(), sorted.end());
  AreaClasses result{.class_of = std::vector<std::uint32_t>(areas.size(), kNone), .value = {}};
  for (const auto& [area, triangle] : sorted) {
    if (result.value.empty() || area - result.value.back() > kSameArea * area) result.value.push_back(area);
    result.class_of[triangle] = static_cast<std::uint32_t>(result.value.size() - 1);
  }
  return result;
}

AreaClasses area_classes(std::span<const double> areas, std::span<const std::uint8_t> kept, std::size_t dim) {
  AreaClasses classes = distinct_areas(areas, kept);
  if (classes.value.size() <= dim) return classes;
  const std::vector<std::uint32_t> starts = merge_classes(classes.value, dim);
  std::vector<std::uint32_t> group_of(classes.value.size());
  std::vector<double> means;
  for (std::size_t g = 0; g < starts.size(); ++g) {
    const std::size_t end = g + 1 < starts.size() ? starts[g + 1] : classes.value.size();
    long double sum = 0;
    for (std::size_t v = starts[g]; v < end; ++v) {
      sum += classes.value[v];
      group_of[v] = static_cast<std::uint32_t>(g);
    }
    means.push_back(static_cast<double>(sum / static_cast<long double>(end - starts[g])));
  }
  for (std::uint32_t& c : classes.class_of)
    if (c != kNone) c = group_of[c];
  classes.value = std::move(means);
  return classes;
}

}  // namespace scene_analyzer::reference
