#include "library/json_text.h"

#include <stdexcept>
#include <string_view>

namespace scene_analyzer::library {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
constexpr std::string_view kDigits = "0123456789abcdef";

bool is_utf8(const std::string& bytes) {
  try {
    static_cast<void>(json(bytes).dump());
    return true;
  } catch (const json::type_error&) {
    return false;
  }
}

std::string to_hex(const std::string& bytes) {
  std::string digits;
  for (const char byte : bytes) {
    const auto value = static_cast<unsigned char>(byte);
    digits += kDigits[value >> 4];
    digits += kDigits[value & 15];
  }
  return digits;
}

std::string from_hex(const std::string& digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    const std::size_t high = kDigits.find(digits[i]), low = kDigits.find(digits[i + 1]);
    if (high == std::string_view::npos || low == std::string_view::npos) return {};
    bytes += static_cast<char>(high << 4 | low);
  }
  return bytes;
}

}  // namespace

void put_bytes(ordered_json& object, const std::string& key, const std::string& bytes) {
  object[key] = bytes;
  if (!is_utf8(bytes)) object[key + "_hex"] = to_hex(bytes);
}

std::string get_bytes(const json& object, const std::string& key) {
  const auto hex = object.find(key + "_hex");
  return hex == object.end() ? object.at(key).get<std::string>() : from_hex(hex->get<std::string>());
}

ordered_json keys_of(analysis::MetricSet metrics) {
  ordered_json keys = ordered_json::array();
  for (std::size_t i = 0; i < analysis::kMetricCount; ++i)
    if (metrics[i]) keys.push_back(analysis::kMetricKeys[i]);
  return keys;
}

analysis::MetricSet metrics_of(const json& keys) {
  analysis::MetricSet metrics;
  for (const auto& key : keys) {
    const auto metric = analysis::metric_of(key.get<std::string>());
    if (!metric) throw std::invalid_argument("an unknown metric");
    metrics.set(index_of(*metric));
  }
  return metrics;
}

std::string one_line_of(const ordered_json& object) {
  return object.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace scene_analyzer::library
