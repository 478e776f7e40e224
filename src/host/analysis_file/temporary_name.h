// temporary_name.h — Names of files that are being written, so that prune() knows what an interrupted write
// left.
#pragma once

#include <string>
#include <string_view>

namespace scene_analyzer::analysis_file {

inline constexpr std::string_view kTemporaryPrefix = ".scene-analyzer-";
inline constexpr std::string_view kTemporarySuffix = ".analysis.tmp";

// A new random name; short whatever the file's own name is, so that it fits where that one does.
std::string temporary_name();

inline bool is_temporary_name(std::string_view name) {
  return name.size() > kTemporaryPrefix.size() + kTemporarySuffix.size() &&
         name.starts_with(kTemporaryPrefix) && name.ends_with(kTemporarySuffix);
}

}  // namespace scene_analyzer::analysis_file
