// table.cpp — The report for people: one line per mesh, rating cells coloured by what they say.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/gap_text.h"
#include "report/mesh_names.h"
#include "report/report.h"
#include "report/terminal_text.h"

namespace scene_analyzer::report {
namespace {

using analysis::GeometryAnalysis;
using analysis::InstanceAnalysis;
using analysis::kMetricCount;
using analysis::kMetricSymbols;
using analysis::Metric;

constexpr std::size_t kCountWidth = 9;   // 100 million triangles; longer counts push their row aside
constexpr std::size_t kRatingWidth = 7;  // -0.1234
constexpr std::size_t kNumbersWidth = 2 * (1 + kCountWidth) + (kMetricCount + 1) * (1 + kRatingWidth);
// Before an R_ft whose start triangle is not proven; "~0.0917" fills a cell of an unsigned rating.
constexpr std::string_view kOpenMark = "~";

struct Row {
  std::u32string name;
  const GeometryAnalysis* geometry = nullptr;
  const ratings::MeshRating* rating = nullptr;
};

std::vector<Row> rows_of(const SceneReport& report, std::size_t count) {
  const std::vector<std::string> prefixes = asset_prefixes(report.assets);
  std::vector<Row> rows;
  rows.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const ratings::MeshRating& mesh = report.rating.meshes[i];
    const analysis::AssetAnalysis& asset = report.assets[mesh.asset];
    const InstanceAnalysis& instance = asset.instances.at(mesh.instance);
    rows.push_back(
        {shown_name(prefixes[mesh.asset], instance), &asset.geometries.at(instance.geometry), &mesh});
  }
  return rows;
}

std::size_t name_width(const std::vector<Row>& rows, std::size_t terminal) {
  std::size_t widest = kLeastNameWidth;
  for (const Row& row : rows) widest = std::max(widest, columns(row.name));
  if (terminal == 0) return widest;
  const std::size_t left = terminal > kNumbersWidth ? terminal - kNumbersWidth : 0;
  return std::clamp(left, kLeastNameWidth, widest);
}

std::string rating_text(const std::optional<double>& rating) {
  if (!rating) return "-";
  // Never "-0.0000".
  return fmt::format("{:.4f}", std::abs(*rating) < 0.00005 ? 0.0 : *rating);
}

void append_rating(std::string& out, const std::optional<double>& rating, const TableStyle& style,
                   std::string_view mark = "") {
  const std::string text =
      fmt::format("{:>{}}", (rating ? std::string(mark) : "") + rating_text(rating), kRatingWidth);
  out += ' ';
  if (!style.color || !rating) {
    out += text;
    return;
  }
  const ratings::Rgb color = ratings::color(*rating);
  const auto byte = [](double channel) { return std::lround(channel * 255); };
  const double luminance = 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2];
  out += fmt::format("\x1b[48;2;{};{};{}m\x1b[38;2;{}m{}\x1b[0m", byte(color[0]), byte(color[1]),
                     byte(color[2]), luminance > 0.45 ? "0;0;0" : "255;255;255", text);
}

std::string count_text(const std::optional<std::uint64_t>& count) {
  // Digits only: what stands here can be searched for in JSON and CSV.
  return fmt::format(" {:>{}}", count ? fmt::to_string(*count) : "-", kCountWidth);
}

// How much farther another triangle than the signal's start may lie, or 0: R_ft may depend on it.
double gap_of(const GeometryAnalysis& geometry) {
  return geometry.signal ? geometry.signal->gap : 0;
}

std::string head_line(std::size_t width) {
  std::string line = padded_name(U"name", width);
  line += fmt::format(" {:>{}} {:>{}}", "triangles", kCountWidth, "groups", kCountWidth);
  for (const std::string_view symbol : kMetricSymbols) line += fmt::format(" {:>{}}", symbol, kRatingWidth);
  return line + fmt::format(" {:>{}}\n", "R", kRatingWidth);
}

void append_row(std::string& out, const Row& row, std::size_t width, const SceneReport& report,
                const TableStyle& style) {
  const bool known = row.geometry->not_analysed.empty();
  out += padded_name(row.name, width);
  out += count_text(known ? std::optional(row.geometry->triangles) : std::nullopt);
  out += count_text(row.geometry->planar_groups);
  // The aggregate is made of these, so they are the ones to show beside it.
  const auto& shown = report.options.relative ? row.rating->relative_ratings : row.rating->ratings;
  for (std::size_t i = 0; i < kMetricCount; ++i) {
    const bool open = i == index_of(Metric::kFourierTransform) && gap_of(*row.geometry) > 0;
    append_rating(out, shown[i], style, open ? kOpenMark : "");
  }
  append_rating(out, row.rating->aggregate, style);
  out += '\n';
}

// What the mark beside an R_ft means, in lines that fit wherever a row does; nothing where no mesh has it.
std::string gap_note(const SceneReport& report) {
  std::size_t meshes = 0;
  double widest = 0;
  for (const ratings::MeshRating& mesh : report.rating.meshes) {
    const analysis::AssetAnalysis& asset = report.assets[mesh.asset];
    const double gap = gap_of(asset.geometries.at(asset.instances.at(mesh.instance).geometry));
    if (!(gap > 0) || !mesh.ratings[index_of(Metric::kFourierTransform)]) continue;
    ++meshes;
    widest = std::max(widest, gap);
  }
  if (meshes == 0) return "";
  return fmt::format(
      "{0} R_ft is not final for {1}: it depends on which triangle lies farthest from the others.\n"
      "  The search for it ended early: another one may lie up to {2} farther out (worst mesh).\n"
      "  A larger --start-searches looks longer.\n",
      kOpenMark, plural(meshes, "mesh", "meshes"), gap_percent(widest));
}

// What R_rt means, which is nothing without the device.
std::string timing_note(const SceneReport& report) {
  const ratings::SceneRating& rating = report.rating;
  if (!rating.timing || !report.options.metrics[index_of(Metric::kRenderingTime)]) return "";
  std::uint64_t not_measured = 0;
  for (const ratings::MeshRating& mesh : rating.meshes)
    if (mesh.rendering_time && !mesh.rendering_time->not_measured.empty()) ++not_measured;
  std::string note =
      fmt::format("R_rt was measured on {}", encode_utf8(printable(rating.timing->device.name)));
  if (rating.timing->device.type == "cpu") note += ", a CPU device: it says nothing about a GPU";
  if (not_measured > 0) note += fmt::format("; {} not measured", plural(not_measured, "mesh", "meshes"));
  return note + '\n';
}

std::string totals_line(const SceneReport& report) {
  const ratings::SceneRating& scene = report.rating;
  std::uint64_t not_analysed = 0, no_fourier_transform = 0;
  for (const ratings::MeshRating& mesh : scene.meshes) {
    const analysis::AssetAnalysis& asset = report.assets[mesh.asset];
    const analysis::GeometryAnalysis& geometry =
        asset.geometries.at(asset.instances.at(mesh.instance).geometry);
    if (!geometry.not_analysed.empty()) ++not_analysed;
    if (!geometry.no_fourier_transform.empty()) ++no_fourier_transform;
  }
  std::string line = plural(scene.meshes.size(), "mesh", "meshes") + ", " +
                     plural(scene.drawn_triangles, "triangle", "triangles");
  if (scene.unique_triangles != scene.drawn_triangles)
    line += fmt::format(" ({} unique)", scene.unique_triangles);
  if (scene.degenerate_triangles > 0)
    line += fmt::format(", {} degenerate left out", scene.degenerate_triangles);
  if (not_analysed > 0) line += fmt::format(", {} not analysed", plural(not_analysed, "mesh", "meshes"));
  if (no_fourier_transform > 0)
    line += fmt::format(", {} without a Fourier rating", plural(no_fourier_transform, "mesh", "meshes"));
  if (report.options.relative) line += "; ratings relative to this scene";
  return line + '\n';
}

}  // namespace

std::string table(const SceneReport& report, const TableStyle& style) {
  const UnicodeScope unicode;
  const std::size_t total = report.rating.meshes.size();
  const std::size_t shown = style.max_rows == 0 ? total : std::min(total, style.max_rows);
  const std::vector<Row> rows = rows_of(report, shown);
  const std::size_t width = name_width(rows, style.width);

  std::string out = head_line(width);
  for (const Row& row : rows) append_row(out, row, width, report, style);
  if (shown < total)
    out += fmt::format("... and {} (all of them are in the JSON and CSV reports)\n",
                       plural(total - shown, "more mesh", "more meshes"));
  const std::size_t rule = width + kNumbersWidth;
  out += std::string(style.width == 0 ? rule : std::min(rule, style.width), '-') + '\n';
  return out + totals_line(report) + gap_note(report) + timing_note(report);
}

}  // namespace scene_analyzer::report
