// file_checks.h — Is the file what its name says, and is it whole? Asked before Assimp, which often takes
// less for all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace scene_analyzer::import {

// `asset` is a path below the current directory. Throws InputError (without the asset's name) for Git LFS
// pointers, web pages, images and other formats under a wrong name, UTF-16 text, and STL and PLY files that
// are shorter than their counts. Cost: the first bytes; binary PLY: one pass over elements that hold lists.
void check_file(const std::string& asset, std::vector<std::string>& warnings);

// What Assimp has to read in place of the file, or empty: indented lines of OBJ.
std::string replacement_for(const std::string& asset);

// Throws InputError where Assimp skipped everything without a word; a part of it is a warning. `triangles`
// are those of the scene. Cost: OBJ: one pass over the file.
void require_content(const std::string& asset, std::size_t meshes, std::uint64_t triangles,
                     std::vector<std::string>& warnings);

// Assimp's message, made to be read by someone who knows the file but not Assimp. Looks at the file's start.
std::string explain_failure(const std::string& assimp_message, const std::string& asset);

}  // namespace scene_analyzer::import
