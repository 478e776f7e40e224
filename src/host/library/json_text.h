// json_text.h — Bytes of any kind in JSON, which knows text only, and sets of metrics. Inside this room only.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "analysis/metric.h"

namespace scene_analyzer::library {

// Sets object[key], and where `bytes` are no UTF-8 object[key + "_hex"], which then holds them.
void put_bytes(nlohmann::ordered_json& object, const std::string& key, const std::string& bytes);
// Throws nlohmann::json::exception where put_bytes() has not made it.
std::string get_bytes(const nlohmann::json& object, const std::string& key);

// A list of keys.
nlohmann::ordered_json keys_of(analysis::MetricSet metrics);
// Throws nlohmann::json::exception and std::invalid_argument where keys_of() has not made it.
analysis::MetricSet metrics_of(const nlohmann::json& keys);

// One line, with a question mark for what is no UTF-8.
std::string one_line_of(const nlohmann::ordered_json& object);

}  // namespace scene_analyzer::library
