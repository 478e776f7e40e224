// document.h — The report as JSON values. JSON prints them, CSV flattens them: that is how field names stay
// equal.
//
// Numbers that JSON cannot hold (NaN, infinity) and everything absent are null; -0 becomes 0.
#pragma once

#include <nlohmann/json.hpp>

#include "report/report.h"

namespace scene_analyzer::report {

// schema_version, tool, parameters, scene, assets: all but the meshes.
nlohmann::ordered_json document_head(const SceneReport& report);

// One element of "meshes". `index` < report.rating.meshes.size(). Keys and their order are the same for every
// mesh.
nlohmann::ordered_json mesh_row(const SceneReport& report, std::size_t index);

// Invalid UTF-8 becomes U+FFFD.
std::string print(const nlohmann::ordered_json& value, int indent = -1);

}  // namespace scene_analyzer::report
