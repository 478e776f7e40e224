// worker_binary.h — Which program the import worker is.
#pragma once

#include <string>

namespace scene_analyzer::import {

// The program that is nothing but the worker: it needs none of the libraries of everything else, and starts
// in a third of the time. This program itself does the same, where that one is not installed or was replaced
// by another version since the first look: find_worker(), or the first call of this. By any thread.
std::string worker_program();

}  // namespace scene_analyzer::import
