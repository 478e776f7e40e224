// load_record.h — The analysis that a record names. Inside this room only.
#pragma once

#include <filesystem>
#include <string>
#include <variant>

#include "analysis/analysis.h"
#include "library/output_folder.h"
#include "library/record.h"

namespace scene_analyzer::library {

// Or why it cannot be had: the file is gone or damaged, of other contents than the record says, or made under
// other options than the library's. It bears the asset's path as the library lists it, and of rendering times
// only those of the library's size and steps.
std::variant<analysis::AssetAnalysis, std::string> load_record(const std::filesystem::path& folder,
                                                               const Record& record,
                                                               const Manifest& manifest);

}  // namespace scene_analyzer::library
