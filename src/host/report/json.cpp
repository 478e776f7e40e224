// json.cpp — The JSON report, described by docs/schema/report-v1.schema.json.
#include "report/document.h"

namespace scene_analyzer::report {
namespace {

// Every line break in printed JSON is layout: those inside strings are escaped.
void append_indented(std::string& out, const std::string& text, const char* indent) {
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    out.append(indent).append(text, start, end - start);
    if (end < text.size()) out.push_back('\n');
    start = end + 1;
  }
}

}  // namespace

std::string json(const SceneReport& report) {
  // Meshes are printed one by one: the whole document as a tree would take some kilobytes per mesh.
  std::string out = print(document_head(report), 2);
  out.resize(out.size() - 2);  // reopen: "\n}"
  out += ",\n  \"meshes\": [";
  for (std::size_t i = 0; i < report.rating.meshes.size(); ++i) {
    out += i == 0 ? "\n" : ",\n";
    const std::size_t before = out.size();
    append_indented(out, print(mesh_row(report, i), 2), "    ");
    // Rows are alike: the first tells the size, so that hundreds of megabytes are not moved again and again.
    if (i == 0) out.reserve(before + (out.size() - before + 16) * report.rating.meshes.size());
  }
  out += report.rating.meshes.empty() ? "]\n}\n" : "\n  ]\n}\n";
  return out;
}

}  // namespace scene_analyzer::report
