// version.h — The program's version, from the one place that states it: project() in the top CMakeLists.txt.
//
// It is printed by --version, stored in analysis files and part of their content key. Rooms get the
// definition by depending on `base`.
#pragma once

#include <string_view>

#ifndef SCENE_ANALYZER_VERSION
#error "SCENE_ANALYZER_VERSION is missing: let the room depend on `base`"
#endif

namespace scene_analyzer {

// "major.minor.patch".
constexpr std::string_view version() {
  return SCENE_ANALYZER_VERSION;
}

}  // namespace scene_analyzer
