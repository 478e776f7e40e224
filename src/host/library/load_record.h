// load_record.h — The analysis that a record names. Inside this room only.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <variant>

#include "analysis/analysis.h"
#include "library/merged.h"
#include "library/output_folder.h"
#include "library/record.h"

namespace scene_analyzer::library {

// Or why it cannot be had: the file is gone or damaged, of other contents than the record says, or made under
// other options than the library's. It bears the asset's path as the library lists it, and of rendering times
// only those of the library's size and steps.
std::variant<analysis::AssetAnalysis, std::string> load_record(const std::filesystem::path& folder,
                                                               const Record& record,
                                                               const Manifest& manifest);

// The same for an asset that was merged, with its rendering times on Merged::timing's kind of device alone:
// what all outputs are made of. Throws InputError.
analysis::AssetAnalysis load_merged(const std::filesystem::path& folder, const Merged& merged,
                                    std::size_t asset);

}  // namespace scene_analyzer::library
