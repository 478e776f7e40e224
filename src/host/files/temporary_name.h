// temporary_name.h — Names of files that are being written, and how to tell what an interrupted write left.
#pragma once

#include <string>
#include <string_view>

namespace scene_analyzer::files {

// A new random name, ".scene-analyzer-<32 hexadecimal digits>.tmp". Made without the name of the file that it
// is to become, so that it fits where that one does, however long that one is. Throws std::system_error where
// the system has no random numbers.
std::string temporary_name();

// Whether temporary_name() makes such names. Deleting by this is safe: nobody names a file of his own so.
bool is_temporary_name(std::string_view name);

}  // namespace scene_analyzer::files
