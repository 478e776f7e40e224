// option_parsing.h — Text of an option -> value. Pure: nothing here reads files, devices or the terminal.
//
// Every function throws UsageError naming the option (`option` is its long name without dashes), the text and
// what is allowed. Numbers are C locale, need to fill the whole text, and are never NaN or infinite.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "analysis/metric.h"
#include "base/nearest.h"
#include "mesh/scene.h"

namespace scene_analyzer::cli {

// A decimal number in [least, greatest]; `unit` is for the message ("degrees") and may be empty.
double parse_number(std::string_view option, std::string_view text, double least, double greatest,
                    std::string_view unit = "");

std::uint64_t parse_integer(std::string_view option, std::string_view text, std::uint64_t least,
                            std::uint64_t greatest);

// "X,Y,Z".
mesh::Vector3 parse_vector3(std::string_view option, std::string_view text);

// "WxH": width and height in pixels, each 1..16384.
std::pair<std::uint32_t, std::uint32_t> parse_pixels(std::string_view option, std::string_view text);

// "KEY,KEY,..." of metric keys, each at most once, at least one.
analysis::MetricSet parse_metrics(std::string_view option, std::string_view text);

// "KEY=W,..." each key at most once, W >= 0, at least one W > 0; keys not named weigh 0.
std::array<double, analysis::kMetricCount> parse_weights(std::string_view option, std::string_view text);

// "500M", "2G", "1.5G", "4096": bytes, with K, M, G, T as powers of 1024.
std::uint64_t parse_size(std::string_view option, std::string_view text);

using scene_analyzer::nearest;

}  // namespace scene_analyzer::cli
