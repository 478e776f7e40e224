// defect_table.cpp — What is wrong with the meshes, for the person who has to mend them.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "report/mesh_names.h"
#include "report/report.h"
#include "report/terminal_text.h"

namespace scene_analyzer::report {
namespace {

using analysis::Defect;
using analysis::DefectPlace;
using analysis::FoundDefect;
using analysis::kDefectCount;

struct Wording {
  std::string_view name, remedy;
};

constexpr std::size_t kKindWidth = 21;
constexpr std::size_t kCountWidth = 9;
constexpr std::size_t kPlacesWidth = 34;
constexpr std::size_t kRemedyWidth = 40;
constexpr std::size_t kNumbersWidth = 1 + kKindWidth + 1 + kCountWidth + 2;

constexpr std::array<Wording, kDefectCount> kWording = {
    {{"degenerate by index", "delete them, they draw nothing"},
     {"degenerate by shape", "delete them, or move their corners apart"},
     {"duplicate triangles", "delete the copies"},
     {"non-manifold edges", "delete inner faces, or split the edges"},
     {"boundary edges", "fill the holes, if it is to be closed"},
     {"inconsistent winding", "make the faces' orientation consistent"},
     {"isolated triangles", "weld them to their neighbours, or delete"},
     {"unreferenced vertices", "delete loose vertices"},
     {"non-finite vertices", "set or delete them; mend the exporter"},
     {"mergeable vertices", "merge them, unless seams keep them apart"},
     {"zero-area mesh", "delete the mesh, or mend its scale"},
     {"far from the origin", "center the mesh, let its node place it"}}};

static_assert(std::ranges::all_of(kWording, [](const Wording& one) {
  return one.name.size() <= kKindWidth && one.remedy.size() <= kRemedyWidth;
}));

const Wording& wording(Defect defect) {
  return kWording[index_of(defect)];
}

struct Row {
  std::u32string name;
  const FoundDefect* defect = nullptr;
};

// How many geometries were looked at and had something, and how often each kind was found.
struct Totals {
  std::uint64_t meshes = 0, with_defects = 0, not_looked_at = 0;
  std::array<std::uint64_t, kDefectCount> counts{};
};

// The name of an instance of each geometry and, where there are others, how many.
std::vector<std::u32string> geometry_names(const analysis::AssetAnalysis& asset, const std::string& prefix) {
  std::vector<std::u32string> names(asset.geometries.size());
  std::vector<std::uint64_t> uses(names.size());
  for (const analysis::InstanceAnalysis& instance : asset.instances)
    if (++uses.at(instance.geometry) == 1) names[instance.geometry] = shown_name(prefix, instance);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (uses[i] > 1) names[i] += printable(fmt::format(" (and {} more)", uses[i] - 1));
  return names;
}

std::vector<Row> rows_of(const SceneReport& report, Totals& totals) {
  const std::vector<std::string> prefixes = asset_prefixes(report.assets);
  std::vector<Row> rows;
  for (std::size_t asset = 0; asset < report.assets.size(); ++asset) {
    const auto& geometries = report.assets[asset].geometries;
    const std::vector<std::u32string> names = geometry_names(report.assets[asset], prefixes[asset]);
    for (std::size_t i = 0; i < geometries.size(); ++i) {
      totals.not_looked_at += geometries[i].defects ? 0 : 1;
      if (!geometries[i].defects) continue;
      ++totals.meshes;
      if (!geometries[i].defects->found.empty()) ++totals.with_defects;
      for (const FoundDefect& one : geometries[i].defects->found) {
        totals.counts[index_of(one.defect)] += one.count;
        rows.push_back({names[i], &one});
      }
    }
  }
  return rows;
}

// As many as fit, and a mark where there are more.
std::string places_text(const FoundDefect& one) {
  if (place_of(one.defect) == DefectPlace::kNone) return "the whole mesh";
  constexpr std::string_view kMore = ", ...";
  const bool triangles = place_of(one.defect) == DefectPlace::kTriangle;
  const std::size_t count = one.places.size();
  // Several edges may lie at one triangle: only a full list may leave some out.
  const bool more = count == analysis::kMostDefectPlaces && one.count > count;
  std::string text = triangles ? "triangle" : "vertex";
  if (count > 1) text = triangles ? "triangles" : "vertices";
  for (std::size_t i = 0; i < count; ++i) {
    const std::string next = fmt::format("{}{}", i == 0 ? " " : ", ", one.places[i]);
    const std::size_t mark = more || i + 1 < count ? kMore.size() : 0;
    if (i > 0 && text.size() + next.size() + mark > kPlacesWidth) return text.append(kMore);
    text += next;
  }
  return more ? text.append(kMore) : text;
}

std::size_t name_width(const std::vector<Row>& rows, std::size_t left) {
  std::size_t widest = kLeastNameWidth;
  for (const Row& row : rows) widest = std::max(widest, columns(row.name));
  return std::clamp(left, kLeastNameWidth, widest);
}

std::string line(std::string_view kind, std::string_view count, std::string_view places,
                 std::string_view remedy) {
  std::string text =
      fmt::format(" {:<{}} {:>{}}  {:<{}}", kind, kKindWidth, count, kCountWidth, places, kPlacesWidth);
  if (!remedy.empty()) text += fmt::format("  {}", remedy);
  text.erase(text.find_last_not_of(' ') + 1);
  return text + '\n';
}

// Where rows have no room for it.
std::string remedies(const Totals& totals) {
  std::string text = "What to do:\n";
  for (std::size_t kind = 0; kind < kDefectCount; ++kind)
    if (totals.counts[kind] > 0)
      text += fmt::format("  {:<{}}  {}\n", kWording[kind].name, kKindWidth, kWording[kind].remedy);
  return text;
}

std::string totals_text(const Totals& totals, std::size_t width) {
  std::string meshes = plural(totals.meshes, "mesh", "meshes");
  if (totals.not_looked_at > 0) meshes += fmt::format(" ({} not analysed)", totals.not_looked_at);
  if (totals.with_defects == 0) return fmt::format("no defects in {}\n", meshes);
  std::string text = fmt::format("{} of {} with defects:", totals.with_defects, meshes);
  std::size_t line_begin = 0;
  for (std::size_t kind = 0, said = 0; kind < kDefectCount; ++kind) {
    if (totals.counts[kind] == 0) continue;
    if (said++ > 0) text += ',';
    const std::string next = fmt::format(" {} {}", totals.counts[kind], kWording[kind].name);
    if (width > 0 && text.size() - line_begin + next.size() + 1 > width) {
      line_begin = text.size() + 1;
      text += "\n ";
    }
    text += next;
  }
  return text + '\n';
}

// Whose vertices these are, in lines that fit wherever rows do.
std::string vertex_note(const Totals& totals) {
  if (totals.counts[index_of(Defect::kMergeableVertices)] == 0) return "";
  return "Vertices are counted as imported: of OBJ, FBX, Collada, 3DS and some others one\n"
         "  per corner of a face, so that those to be merged need not be in the file.\n";
}

}  // namespace

std::string defect_table(const SceneReport& report, const TableStyle& style) {
  const UnicodeScope unicode;
  Totals totals;
  const std::vector<Row> rows = rows_of(report, totals);
  const std::size_t shown = style.max_rows == 0 ? rows.size() : std::min(rows.size(), style.max_rows);
  if (rows.empty()) return totals_text(totals, style.width);

  constexpr std::size_t kWithRemedy = kNumbersWidth + kPlacesWidth + 2 + kRemedyWidth;
  const bool wide = style.width == 0 || style.width >= kLeastNameWidth + kWithRemedy;
  const std::size_t taken = wide ? kWithRemedy : kNumbersWidth + kPlacesWidth;
  const std::size_t left = style.width == 0 ? kMostNameWidth : style.width > taken ? style.width - taken : 0;
  const std::size_t width = name_width(rows, left);

  std::string out =
      padded_name(U"name", width) + line("defect", "count", "first places", wide ? "what to do" : "");
  for (const Row& row : std::span(rows).first(shown)) {
    const Wording& words = wording(row.defect->defect);
    out += padded_name(row.name, width) + line(words.name, fmt::to_string(row.defect->count),
                                               places_text(*row.defect), wide ? words.remedy : "");
  }
  if (shown < rows.size())
    out += fmt::format("... and {} (all of them are in the JSON report)\n",
                       plural(rows.size() - shown, "more line", "more lines"));
  const std::size_t rule = width + taken;
  out += std::string(style.width == 0 ? rule : std::min(rule, style.width), '-') + '\n';
  return out + totals_text(totals, style.width) + (wide ? "" : remedies(totals)) + vertex_note(totals);
}

}  // namespace scene_analyzer::report
