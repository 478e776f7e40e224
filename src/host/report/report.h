// report.h — One analysed scene as table, JSON and CSV. Field names are the same in all three (docs/schema).
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "analysis/analysis.h"
#include "ratings/ratings.h"

namespace scene_analyzer::report {

struct SceneReport {
  std::string tool_version;
  analysis::DeviceStamp device;  // empty strings when nothing had to be computed
  analysis::Parameters parameters;
  ratings::Options options;
  std::span<const analysis::AssetAnalysis> assets;
  ratings::SceneRating rating;
};

struct TableStyle {
  bool color = false;        // ANSI 24-bit background of rating cells
  std::size_t width = 0;     // columns of the terminal, 0: unlimited; long names are shortened in the middle
  std::size_t max_rows = 0;  // 0: all
};

std::string table(const SceneReport& report, const TableStyle& style);
std::string json(const SceneReport& report);  // UTF-8, two-space indent, trailing newline; deterministic
std::string csv(const SceneReport& report);   // RFC 4180, header line, LF

// Writes to a temporary name beside `path`, syncs, renames; "-" writes to standard output.
// Throws InputError with the system's reason.
void write_file(const std::filesystem::path& path, const std::string& contents);

}  // namespace scene_analyzer::report
