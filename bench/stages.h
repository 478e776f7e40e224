// stages.h — What is timed: the stages in the order of the recipe, and the recipe itself.
#pragma once

#include <time.h>

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

// Seconds of one run.
struct Elapsed {
  double wall = 0;
  double cpu = 0;  // of all threads of this process; a CPU device's among them
};

template <typename Work>
Elapsed elapsed_of(const Work& work) {
  const auto cpu = [] {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double cpu_started = cpu();
  const auto started = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started;
  return {.wall = wall.count(), .cpu = cpu() - cpu_started};
}

}  // namespace scene_analyzer::bench
