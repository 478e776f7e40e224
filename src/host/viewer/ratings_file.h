// ratings_file.h — Files that the review window writes: numbered, and never over another one.
#pragma once

#include <filesystem>
#include <string_view>

#include "report/report.h"

namespace scene_analyzer::viewer {

// The first of <prefix>1<suffix>, <prefix>2<suffix>, ... that is not in `folder` (empty: the working folder).
// Only a look: another program may take it before it is written. Throws InputError when the folder cannot be
// searched. Cost: linear in the names that are taken.
std::filesystem::path next_free_name(const std::filesystem::path& folder, std::string_view prefix,
                                     std::string_view suffix);

// Writes `bytes` under the first such name that nobody takes before, and returns it; what is there already is
// neither written to nor replaced. A killed write leaves an empty file or a whole one. Throws InputError with
// the system's reason, and then leaves nothing.
std::filesystem::path write_numbered(const std::filesystem::path& folder, std::string_view prefix,
                                     std::string_view suffix, std::string_view bytes);

// report::csv() as scene-ratings-1.csv, scene-ratings-2.csv, ...; returns and throws as above.
std::filesystem::path write_ratings(const report::SceneReport& report, const std::filesystem::path& folder);

}  // namespace scene_analyzer::viewer
