// obj_check.h — What Assimp silently leaves out of OBJ files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace scene_analyzer::import {

// Face lines ("f") of at least three corners, whatever the corners are; a line that ends with a backslash
// goes on in the next. Each is one triangle or more. Cost: one pass.
std::uint64_t count_obj_faces(std::string_view contents);

// The file without the spaces in front of its lines, which Assimp takes for lines to skip; empty where there
// are none. What follows a backslash at a line's end stays as it is. Cost: one pass, memory once for the
// file.
std::string without_indentation(std::string_view contents);

}  // namespace scene_analyzer::import
