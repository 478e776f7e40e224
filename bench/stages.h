// stages.h — What is timed: the stages in the order of the recipe, and the recipe itself.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>

namespace scene_analyzer::bench {

enum class Stage : std::size_t { kGeometry, kAdjacency, kPlanarGroups, kAreaClasses, kContrast };
inline constexpr std::size_t kStageCount = 5;
inline constexpr std::array<std::string_view, kStageCount> kStageNames = {
    "geometry", "adjacency", "planar_groups", "area_classes", "contrast"};
inline constexpr std::string_view kWhole = "whole";

template <typename Work>
double seconds_of(const Work& work) {
  const auto started = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
}

}  // namespace scene_analyzer::bench
