// ply_check.h — Does a PLY file hold what its header counts?
#pragma once

#include <string_view>

namespace scene_analyzer::import {

// Throws InputError (without the file's name) when the data is shorter than the header promises. Files whose
// header is not understood pass: Assimp has the word then. Cost: the header; binary files with lists: one
// pass over them.
void check_ply(std::string_view contents);

}  // namespace scene_analyzer::import
