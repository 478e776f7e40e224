// file_checks.h — Is the file what its name says, and is it whole? Asked before Assimp, which often takes
// less for all.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace scene_analyzer::import {

// `asset` is a path below the current directory. Throws InputError (without the asset's name) for Git LFS
// pointers, web pages, images and other formats under a wrong name, UTF-16 text, and STL and PLY files that
// are shorter than their counts. Cost: the first bytes; binary PLY: one pass over elements that hold lists.
void check_file(const std::string& asset, std::vector<std::string>& warnings);

// Throws InputError for formats of which Assimp is known to skip everything without a word.
void require_content(const std::string& asset, std::size_t meshes);

// Assimp's message, made to be read by someone who knows the file but not Assimp.
std::string explain_failure(const std::string& assimp_message, const std::string& asset);

}  // namespace scene_analyzer::import
