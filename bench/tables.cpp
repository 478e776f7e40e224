#include "tables.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <thread>

#include "gpu/host_memory.h"

namespace scene_analyzer::bench {
namespace {

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

Elapsed least_of(const Elapsed& a, const Elapsed& b) {
  return {.wall = std::min(a.wall, b.wall), .cpu = std::min(a.cpu, b.cpu)};
}

double per_triangle(double seconds, std::uint64_t triangles) {
  return seconds * 1e9 / static_cast<double>(triangles);
}

const Row* find_whole(const std::vector<Row>& rows, std::string_view which) {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const Row& row) { return row.which == which && row.stage == kWhole; });
  return found == rows.end() ? nullptr : &*found;
}

const char* verdict(bool met) {
  return met ? "met" : "missed";
}

void print_flatness(const std::vector<Row>& rows, const std::string& kind) {
  const Row* small = find_whole(rows, kind + "/100k");
  const Row* large = find_whole(rows, kind + "/10M");
  if (small == nullptr || large == nullptr) return;
  const double factor = per_triangle(large->least().device.wall, large->triangles) /
                        per_triangle(small->least().device.wall, small->triangles);
  fmt::print("| cost per triangle, {} 10M against 100k | {:.2f} | at most 1.5 | {} |\n", kind, factor,
             verdict(factor <= 1.5));
}

}  // namespace

Round Row::least() const {
  Round least = rounds.front();
  for (const Round& round : rounds) {
    least.device = least_of(least.device, round.device);
    least.twin = least_of(least.twin, round.twin);
  }
  return least;
}

double Row::median_ratio() const {
  std::vector<double> ratios;
  for (const Round& round : rounds) ratios.push_back(round.device.wall / round.twin.wall);
  return median_of(std::move(ratios));
}

void print_machine(const gpu::DeviceInfo& device) {
  double load = 0;
  std::ifstream("/proc/loadavg") >> load;
  fmt::print("\n{:%Y-%m-%d}, {} ({}), on {} with {} threads; load average {:.1f}.\n",
             fmt::gmtime(std::time(nullptr)), device.name, device.driver, gpu::processor_name(),
             std::thread::hardware_concurrency(), load);
}

void print_rows(const std::vector<Row>& rows) {
  fmt::print(
      "\n| mesh | stage | triangles | device ms | device CPU ms | twin ms | ratio | median ratio | "
      "device ns/triangle | bytes/triangle |\n|---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const Row& row : rows) {
    const Round least = row.least();
    const std::string bytes =
        row.stage == kWhole
            ? fmt::format("{:.0f}", static_cast<double>(row.peak_bytes) / static_cast<double>(row.triangles))
            : "";
    fmt::print("| {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.2f} | {:.0f} | {} |\n", row.which,
               row.stage, row.triangles, least.device.wall * 1e3, least.device.cpu * 1e3,
               least.twin.wall * 1e3, row.ratio(), row.median_ratio(),
               per_triangle(least.device.wall, row.triangles), bytes);
  }
}

void print_kernels(const KernelTable& table) {
  double all = 0;
  for (const Profile& stage : table.stages)
    for (const auto& [name, seconds] : stage.parts) all += seconds;
  fmt::print(
      "\nWhere the time goes, {} ({} triangles; parts under 0.5 % left out):\n\n"
      "| stage | kernel | ms | ns/triangle | share |\n|---|---|--:|--:|--:|\n",
      table.which, table.triangles);
  for (const Profile& stage : table.stages)
    for (const auto& [name, seconds] : stage.parts)
      if (seconds >= 0.005 * all)
        fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.1f} % |\n",
                   kStageNames[static_cast<std::size_t>(stage.stage)], name, seconds * 1e3,
                   per_triangle(seconds, table.triangles), 100 * seconds / all);
}

void print_targets(const std::vector<Row>& rows) {
  fmt::print("\n| figure | value | target | |\n|---|--:|---|---|\n");
  for (const Row& row : rows) {
    if (row.stage != kWhole || row.triangles < 900'000) continue;
    const double ratio = row.ratio();
    fmt::print("| device / twin, {} | {:.2f} | at most 1 | {} |\n", row.which, ratio, verdict(ratio <= 1));
  }
  print_flatness(rows, "heightfield");
  print_flatness(rows, "geosphere");
  for (const Row& row : rows) {
    if (row.stage != kWhole || row.triangles < 90'000) continue;
    const double bytes = static_cast<double>(row.peak_bytes) / static_cast<double>(row.triangles);
    fmt::print("| device bytes per triangle, {} | {:.0f} | under 200 | {} |\n", row.which, bytes,
               verdict(bytes < 200));
  }
  const Row* apart = find_whole(rows, "boxes_apart/240k");
  const Row* joined = find_whole(rows, "boxes_joined/240k");
  if (apart == nullptr || joined == nullptr) return;
  const double factor = apart->least().device.wall / joined->least().device.wall;
  fmt::print("| 20000 meshes of 12 triangles against the same in one mesh | {:.2f} | at most 3 | {} |\n",
             factor, verdict(factor <= 3));
}

}  // namespace scene_analyzer::bench
