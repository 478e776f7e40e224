#include "library/record.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "library/json_text.h"

namespace scene_analyzer::library {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

Status status_of(const std::string& key) {
  const auto found = std::ranges::find(kStatusKeys, key);
  if (found == kStatusKeys.end()) throw std::invalid_argument("no status");
  return static_cast<Status>(found - kStatusKeys.begin());
}

Record read(const json& line) {
  Record record;
  record.asset = get_bytes(line, "asset");
  record.status = status_of(line.at("status").get<std::string>());
  record.reason = line.value("reason", "");
  if (line.contains("analysis")) record.analysis = get_bytes(line, "analysis");
  record.content_key = line.value("content_key", "");
  record.metrics = metrics_of(line.at("metrics"));
  record.bytes = line.at("bytes").get<std::uint64_t>();
  record.meshes = line.at("meshes").get<std::uint64_t>();
  record.triangles = line.at("triangles").get<std::uint64_t>();
  record.import_seconds = line.at("import_seconds").get<double>();
  record.seconds = line.at("seconds").get<double>();
  record.warning_count = line.at("warning_count").get<std::uint64_t>();
  record.warnings = line.at("warnings").get<std::vector<std::string>>();
  record.finished = line.at("finished").get<std::string>();
  return record;
}

}  // namespace

std::string to_line(const Record& record) {
  ordered_json line;
  put_bytes(line, "asset", record.asset);
  line["status"] = kStatusKeys[static_cast<std::size_t>(record.status)];
  if (!record.reason.empty()) line["reason"] = record.reason;
  if (!record.analysis.empty()) put_bytes(line, "analysis", record.analysis);
  if (!record.content_key.empty()) line["content_key"] = record.content_key;
  line["metrics"] = keys_of(record.metrics);
  line["bytes"] = record.bytes;
  line["meshes"] = record.meshes;
  line["triangles"] = record.triangles;
  line["import_seconds"] = record.import_seconds;
  line["seconds"] = record.seconds;
  line["warning_count"] = record.warning_count;
  line["warnings"] = record.warnings;
  line["finished"] = record.finished;
  return one_line_of(line);
}

std::optional<Record> record_of(std::string_view line) {
  try {
    return read(json::parse(line));
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

std::string utc_now() {
  using namespace std::chrono;
  const auto now = system_clock::now();
  const auto milliseconds_only = duration_cast<milliseconds>(now.time_since_epoch()).count() % 1000;
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(system_clock::to_time_t(now)),
                     milliseconds_only);
}

}  // namespace scene_analyzer::library
