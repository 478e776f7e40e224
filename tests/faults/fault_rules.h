// fault_rules.h — Which Vulkan calls fault_layer.cpp makes fail, as its environment variables say it.
//
//   SCENE_ANALYZER_FAULT         FUNCTION:FIRST[+|-LAST]=WHAT[,...]
//     vkQueueSubmit2:3=device_lost                      the third call fails, and all of the device after it
//     vkAllocateMemory:5+=out_of_device_memory          the fifth call and all after it fail
//     vkAcquireNextImageKHR:2-4=out_of_date             calls 2 to 4
//     vkGetPhysicalDeviceSurfaceCapabilitiesKHR:2-9=zero_extent    a window without any pixels
//     vkGetPhysicalDeviceSurfaceSupportKHR:1+=false
//     vkWaitForFences:4+=timeout                        the device hangs
//   SCENE_ANALYZER_FAULT_COUNTS  a file that gets a line "FUNCTION COUNT" per function when the layer is
//   unloaded
//
// Calls are counted from 1 per function, over all devices of the process.
#pragma once

#include <charconv>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace scene_analyzer::faults {

inline constexpr const char* kFaultLayer = "VK_LAYER_SCENE_ANALYZER_fault";  // as in the manifest
inline constexpr const char* kRulesVariable = "SCENE_ANALYZER_FAULT";
inline constexpr const char* kCountsVariable = "SCENE_ANALYZER_FAULT_COUNTS";

enum class Fault : std::uint8_t {
  kDeviceLost,
  kOutOfDeviceMemory,
  kOutOfHostMemory,
  kOutOfDate,
  kSuboptimal,
  kSurfaceLost,
  kTimeout,
  kFalse,       // an answer, not a result: "cannot present"
  kZeroExtent,  // the same: a surface without pixels
};

inline const std::map<std::string_view, Fault> kFaultNames = {
    {"device_lost", Fault::kDeviceLost},
    {"out_of_device_memory", Fault::kOutOfDeviceMemory},
    {"out_of_host_memory", Fault::kOutOfHostMemory},
    {"out_of_date", Fault::kOutOfDate},
    {"suboptimal", Fault::kSuboptimal},
    {"surface_lost", Fault::kSurfaceLost},
    {"timeout", Fault::kTimeout},
    {"false", Fault::kFalse},
    {"zero_extent", Fault::kZeroExtent},
};

struct Rule {
  std::string function;
  std::uint64_t first = 1, last = 1;
  Fault fault = Fault::kDeviceLost;
};

inline std::uint64_t parse_count(std::string_view text) {
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count == 0)
    throw std::invalid_argument("'" + std::string(text) + "' is no count of calls");
  return count;
}

// "FUNCTION:FIRST[+|-LAST]=WHAT"; throws std::invalid_argument.
inline Rule parse_rule(std::string_view text) {
  const std::size_t colon = text.find(':'), equals = text.find('=');
  if (colon == std::string_view::npos || equals == std::string_view::npos || equals < colon)
    throw std::invalid_argument("'" + std::string(text) + "' is not FUNCTION:FIRST=WHAT");
  Rule rule{.function = std::string(text.substr(0, colon))};
  std::string_view calls = text.substr(colon + 1, equals - colon - 1);
  if (const std::size_t dash = calls.find('-'); dash != std::string_view::npos) {
    rule.last = parse_count(calls.substr(dash + 1));
    calls = calls.substr(0, dash);
    rule.first = parse_count(calls);
  } else if (calls.ends_with('+')) {
    rule.last = std::numeric_limits<std::uint64_t>::max();
    rule.first = parse_count(calls.substr(0, calls.size() - 1));
  } else {
    rule.first = rule.last = parse_count(calls);
  }
  const auto fault = kFaultNames.find(text.substr(equals + 1));
  if (fault == kFaultNames.end())
    throw std::invalid_argument("'" + std::string(text.substr(equals + 1)) + "' is no fault");
  rule.fault = fault->second;
  return rule;
}

// Of several rules separated by commas.
inline std::vector<Rule> parse_rules(std::string_view text) {
  std::vector<Rule> rules;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    rules.push_back(parse_rule(text.substr(0, comma)));
    text = comma == std::string_view::npos ? std::string_view() : text.substr(comma + 1);
  }
  return rules;
}

// Counts calls and says which are to fail. Not for several threads at once.
class Plan {
 public:
  explicit Plan(std::vector<Rule> rules) : rules_(std::move(rules)) {}

  std::optional<Fault> next_call(const std::string& function) {
    const std::uint64_t call = ++counts_[function];
    for (const Rule& rule : rules_)
      if (rule.function == function && rule.first <= call && call <= rule.last) return rule.fault;
    return std::nullopt;
  }
  const std::map<std::string, std::uint64_t>& counts() const { return counts_; }

 private:
  std::vector<Rule> rules_;
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace scene_analyzer::faults
