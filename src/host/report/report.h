// report.h — One analysed scene as table, JSON and CSV. Field names are the same in all three (docs/schema).
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

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
// Meshes that have defects, a line per kind: how many, the first places, what to do. A mesh that stands at
// several places is listed once.
std::string defect_table(const SceneReport& report, const TableStyle& style);
std::string json(const SceneReport& report);  // UTF-8, two-space indent, trailing newline; deterministic
std::string csv(const SceneReport& report);   // RFC 4180, header line, LF
// The parts of csv(), for tables of more scenes than memory holds: its header, and the line of one mesh,
// which is the one of that `number` in the whole table.
std::string csv_header();
std::string csv_line(const SceneReport& report, std::size_t mesh, std::size_t number);

// Writes to a temporary name beside `path`, syncs, renames; "-" writes to standard output.
// Throws InputError with the system's reason.
void write_file(const std::filesystem::path& path, const std::string& contents);
// The same in pieces: `produce` hands each to the sink, in order. What it throws leaves the old file.
using Sink = std::function<void(std::string_view bytes)>;
void write_file(const std::filesystem::path& path, const std::function<void(const Sink& sink)>& produce);

}  // namespace scene_analyzer::report
