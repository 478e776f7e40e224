// glb_document.h — The JSON part of an exported scene.
#pragma once

#include <span>
#include <string>

#include "mesh/scene.h"
#include "report/glb_layout.h"
#include "report/report.h"

namespace scene_analyzer::report {

// Appends one JSON object, UTF-8 without line breaks. Makes room for layout.bytes bytes after it, as far as
// the document's size can be foreseen.
void append_document(std::string& out, const SceneReport& report, std::span<const mesh::Scene* const> scenes,
                     const GlbLayout& layout);

}  // namespace scene_analyzer::report
