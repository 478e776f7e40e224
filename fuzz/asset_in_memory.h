// asset_in_memory.h — Files that checks of assets open, without a disk.
//
// asset_in_memory.cpp defines import::MappedFile in place of the room's own: what checks map lies on the heap
// then, where a sanitizer sees a step beyond its end.
#pragma once

#include <string>
#include <string_view>

namespace scene_analyzer::fuzz {

// Every file that is opened from now on holds these bytes; they stay where they are until the next call.
void set_asset(std::string_view bytes);

// Once: a folder of its own for this process, with the file b.bin of 60 bytes in it.
void enter_folder();

}  // namespace scene_analyzer::fuzz
