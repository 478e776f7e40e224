// record.h — What became of one asset of a library: a line of the journal.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/metric.h"

namespace scene_analyzer::library {

enum class Status : std::uint8_t {
  kAnalysed,    // its analysis file is there and whole
  kIncomplete,  // a mesh is beyond a limit of the device or of its memory: nothing is kept
  kFailed       // it could not be read or measured
};
inline constexpr std::array<std::string_view, 3> kStatusKeys = {"analysed", "incomplete", "failed"};

struct Record {
  std::string asset;  // path as listed
  Status status = Status::kFailed;
  std::string reason = {};       // of all but kAnalysed, for people
  std::string analysis = {};     // of kAnalysed: its analysis file, relative to the library's output folder
  std::string content_key = {};  // of kAnalysed, see analysis_file::content_key
  analysis::MetricSet metrics = {};         // that were asked for
  std::uint64_t bytes = 0;                  // of the asset's file
  std::uint64_t meshes = 0, triangles = 0;  // instances, and the kept triangles of each geometry once
  double import_seconds = 0, seconds = 0;   // of reading it, and in all; the last time it was measured
  std::vector<std::string> warnings = {};   // the first of them, kMostWarnings at most
  std::uint64_t warning_count = 0;
  std::string finished =
      {};  // UTC, "2026-01-31T12:00:00.000Z": of two records of an asset the later one counts

  bool operator==(const Record&) const = default;
};
inline constexpr std::size_t kMostWarnings = 8;

// One line of JSON without its end. Paths that are no UTF-8 are kept byte by byte in "asset_hex".
std::string to_line(const Record& record);
// Nothing where the line is no whole record.
std::optional<Record> record_of(std::string_view line);

// The present time as Record::finished has it.
std::string utc_now();

}  // namespace scene_analyzer::library
