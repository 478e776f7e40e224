// helper_program.h — Programs that belong to this one and are started by it.
#pragma once

#include <filesystem>
#include <string_view>

namespace scene_analyzer::files {

// The program of that name beside this one, as in a build folder, or in ../libexec/scene-analyzer seen from
// there, as installed. Empty where there is none.
std::filesystem::path helper_program(std::string_view name);

}  // namespace scene_analyzer::files
