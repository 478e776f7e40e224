// csv.cpp — One line per mesh. Columns are the JSON fields; nested ones are joined by a dot, as in
// ratings.distance, because `distance` (in world units) and the rating of that name both exist.
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

// A mesh with every field that can be null filled in where that changes the columns: signal, rendering time
// and bounds.
ordered_json full_shape() {
  analysis::AssetAnalysis asset;
  asset.geometries.emplace_back().signal = analysis::SignalSummary();
  asset.instances.emplace_back().bounds = analysis::Bounds();
  SceneReport report;
  report.assets = std::span(&asset, 1);
  analysis::RenderingTime time;
  time.mean_ns = 1;
  report.rating.meshes.emplace_back().rendering_time = time;
  report.rating.timing.emplace();
  return mesh_row(report, 0);
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

std::string csv(const SceneReport& report) {
  const ordered_json shape = full_shape();
  std::string out;
  append_header(out, shape, "");
  out.back() = '\n';
  for (std::size_t i = 0; i < report.rating.meshes.size(); ++i) {
    append_cells(out, mesh_row(report, i), shape);
    out.back() = '\n';
  }
  return out;
}

}  // namespace scene_analyzer::report
