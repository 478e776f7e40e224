// csv.cpp — One line per mesh. Columns are the JSON fields; nested ones are joined by a dot, as in
// ratings.distance, because `distance` (in world units) and the rating of that name both exist. Lists of any
// length, which are the places of defects, have no columns.
#include "report/document.h"
#include "report/terminal_text.h"

namespace scene_analyzer::report {
namespace {

using nlohmann::ordered_json;
constexpr const char* kAxes[] = {"x", "y", "z"};

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result.push_back('"');
    result.push_back(c);
  }
  return result + '"';
}

ordered_json csv_row(const SceneReport& report, std::size_t index) {
  ordered_json row = mesh_row(report, index);
  if (!row["defects"].is_null()) row["defects"].erase("places");
  return row;
}

// A mesh with every field that can be null filled in where that changes the columns: defects, signal,
// rendering time and bounds.
ordered_json full_shape() {
  analysis::AssetAnalysis asset;
  asset.geometries.emplace_back().signal = analysis::SignalSummary();
  asset.geometries.back().defects.emplace();
  asset.instances.emplace_back().bounds = analysis::Bounds();
  SceneReport report;
  report.assets = std::span(&asset, 1);
  analysis::RenderingTime time;
  time.mean_ns = 1;
  report.rating.meshes.emplace_back().rendering_time = time;
  report.rating.timing.emplace();
  return csv_row(report, 0);
}

const ordered_json& shape() {
  static const ordered_json shape = full_shape();
  return shape;
}

void append_header(std::string& out, const ordered_json& shape, const std::string& name) {
  if (shape.is_object()) {
    for (const auto& [key, child] : shape.items())
      append_header(out, child, name.empty() ? key : name + '.' + key);
  } else if (shape.is_array()) {
    for (std::size_t i = 0; i < shape.size(); ++i) append_header(out, shape[i], name + '.' + kAxes[i]);
  } else {
    out += quoted(name) + ',';
  }
}

// `value` is null or has the keys of `shape` in its order.
void append_cells(std::string& out, const ordered_json& value, const ordered_json& shape) {
  static const ordered_json null;
  if (shape.is_structured()) {
    auto child = value.begin();
    for (const ordered_json& child_shape : shape) {
      append_cells(out, value.is_null() ? null : *child, child_shape);
      if (!value.is_null()) ++child;
    }
    return;
  }
  if (value.is_string())
    out += quoted(valid_utf8(value.get_ref<const std::string&>()));
  else if (!value.is_null())
    out += print(value);  // the very digits of the JSON report
  out += ',';
}

}  // namespace

std::string csv_header() {
  std::string out;
  append_header(out, shape(), "");
  out.back() = '\n';
  return out;
}

std::string csv_line(const SceneReport& report, std::size_t mesh, std::size_t number) {
  ordered_json row = csv_row(report, mesh);
  row["index"] = number;
  std::string out;
  append_cells(out, row, shape());
  out.back() = '\n';
  return out;
}

std::string csv(const SceneReport& report) {
  std::string out = csv_header();
  for (std::size_t i = 0; i < report.rating.meshes.size(); ++i) out += csv_line(report, i, i);
  return out;
}

}  // namespace scene_analyzer::report
