#include "cli/devices_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/error.h"
#include "cli/command_line.h"
#include "cli/exit_code.h"
#include "cli/lazy_device.h"
#include "cli/logging.h"
#include "cli/selftest.h"

namespace scene_analyzer::cli {
namespace {

constexpr const char* kDetails =
    "The device marked * is used when --device is not given: discrete before integrated before virtual "
    "before\n"
    "processor. Lacking features of an unusable device are named below the table.\n"
    "\n"
    "Environment:\n"
    "  SCENE_ANALYZER_VALIDATION=1  every command runs with the Vulkan validation layer (package\n"
    "                               vulkan-validationlayers); its messages are errors, exit code 2\n"
    "  VK_DRIVER_FILES              which drivers the Vulkan loader looks at\n"
    "\n"
    "Examples:\n"
    "  scene-analyzer devices\n"
    "  scene-analyzer devices --json | jq '.devices[] | select(.usable) | .name'\n"
    "  scene-analyzer devices --selftest --device llvmpipe\n";

Options make_options() {
  Options options("scene-analyzer devices",
                  "Lists the Vulkan devices of this machine and why one cannot be used, or computes known "
                  "results on one.\n");
  options.usage("[OPTION...]");
  options.add("Listing", {
                             {"json", "print JSON in place of the table"},
                         });
  options.add("Testing",
              {
                  {"selftest", "measure built-in meshes whose results are known; exit code 2 if one is off"},
                  {"device", "the device to test: index or part of the name; default the one marked *", "D"},
              });
  add_common_options(options);
  return options;
}

// The device that a run without --device takes, or nothing when none is usable.
const gpu::DeviceInfo* preferred(const std::vector<gpu::DeviceInfo>& devices) {
  const gpu::DeviceInfo* best = nullptr;
  for (const auto& device : devices)
    if (device.refusals.empty() && (best == nullptr || device.type < best->type)) best = &device;
  return best;
}

std::string bytes_text(std::uint64_t bytes) {
  static constexpr std::array<const char*, 4> kUnits = {"KiB", "MiB", "GiB", "TiB"};
  double value = static_cast<double>(bytes) / 1024;
  std::size_t unit = 0;
  while (value >= 1024 && unit + 1 < kUnits.size()) {
    value /= 1024;
    ++unit;
  }
  return fmt::format("{:.{}f} {}", value, value < 10 ? 1 : 0, kUnits[unit]);
}

using Row = std::array<std::string, 9>;

void print_table(const std::vector<gpu::DeviceInfo>& devices) {
  std::vector<Row> rows = {{"", "Index", "Name", "Type", "Driver", "API", "Memory", "Max buffer", "Usable"}};
  const auto* chosen = preferred(devices);
  for (const auto& device : devices)
    rows.push_back({&device == chosen ? "*" : "", std::to_string(device.index), one_line(device.name),
                    gpu::to_string(device.type), one_line(device.driver), device.api_version,
                    bytes_text(device.memory_bytes), bytes_text(device.max_storage_buffer_bytes),
                    device.refusals.empty() ? "yes" : "no"});
  std::array<std::size_t, std::tuple_size_v<Row>> widths{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format("{:<{}}  ", row[i], widths[i]);
    fmt::print("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
  }
  for (const auto& device : devices)
    for (const std::string& reason : device.refusals)
      fmt::print("\ndevice {} ({}) cannot be used: {}", device.index, one_line(device.name),
                 one_line(reason));
  if (std::ranges::any_of(devices, [](const auto& device) { return !device.refusals.empty(); }))
    fmt::print("\n");
}

void print_json(const std::vector<gpu::DeviceInfo>& devices) {
  const auto* chosen = preferred(devices);
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& device : devices)
    list.push_back({{"index", device.index},
                    {"name", device.name},
                    {"type", gpu::to_string(device.type)},
                    {"driver", device.driver},
                    {"api_version", device.api_version},
                    {"memory_bytes", device.memory_bytes},
                    {"free_memory_bytes", device.free_memory_bytes},
                    {"max_storage_buffer_bytes", device.max_storage_buffer_bytes},
                    {"max_allocation_bytes", device.max_allocation_bytes},
                    {"subgroup_size", device.subgroup_size},
                    {"can_draw", device.can_draw},
                    {"timestamp_bits", device.timestamp_bits},
                    {"timestamp_period_ns", device.timestamp_period_ns},
                    {"default", &device == chosen},
                    {"usable", device.refusals.empty()},
                    {"refusals", device.refusals}});
  const nlohmann::ordered_json document = {{"schema_version", 1}, {"devices", std::move(list)}};
  // Names come from drivers: bytes that are no UTF-8 must not turn a listing into a failure.
  fmt::print("{}\n", document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

int list(bool as_json) {
  keep_drivers_off_a_full_disk();
  const auto devices = gpu::list_devices();
  as_json ? print_json(devices) : print_table(devices);
  if (preferred(devices) != nullptr) return kSuccess;
  log_error(
      "no device of this machine can be used; the package mesa-vulkan-drivers brings one that runs on the "
      "processor");
  return kUnusable;
}

int test_device(const std::string& selector) {
  LazyDevice device(device_options(selector));
  const auto& info = device.get().info();
  fmt::print("device {}: {} ({}, {})\n", info.index, one_line(info.name), gpu::to_string(info.type),
             one_line(info.driver));
  const auto checks = run_selftest(device.get());
  std::size_t failed = 0;
  for (const Check& check : checks) {
    fmt::print("{:<6} {:<28} {:<26} expected {:<12} got {}\n", check.good() ? "ok" : "FAILED", check.mesh,
               check.value, fmt::format("{:.9g}", check.expected),
               check.got ? fmt::format("{:.9g}", *check.got) : "nothing");
    failed += check.good() ? 0 : 1;
  }
  const auto validation = device.take_validation_messages();
  for (const std::string& message : validation) log_error(message);
  fmt::print("{} of {} values are right\n", checks.size() - failed, checks.size());
  return failed == 0 && validation.empty() ? kSuccess : kUnusable;
}

}  // namespace

int devices_command(std::span<const std::string> arguments) {
  Options options = make_options();
  const CommandLine line(options, arguments);
  if (line.flag("help")) {
    fmt::print("{}\n{}\n{}", options.help({"Listing", "Testing", "Messages"}), kDetails, kExitCodeHelp);
    return kSuccess;
  }
  set_up_logging(log_level(line.flag("quiet"), line.flag("verbose")));
  if (!line.positional().empty())
    throw UsageError(
        fmt::format("'{}' is not understood; a device is chosen with --device", line.positional()[0]));
  const auto selector = line.value("device");
  if (!line.flag("selftest")) {
    if (selector) throw UsageError("--device goes with --selftest; the list always shows every device");
    return list(line.flag("json"));
  }
  if (line.flag("json")) throw UsageError("--json goes with the list, not with --selftest");
  if (selector && selector->empty()) throw UsageError("--device needs an index or a part of a name");
  return test_device(selector.value_or(""));
}

}  // namespace scene_analyzer::cli
