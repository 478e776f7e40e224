// envelope.h — The bytes around the payload: magic, format version, size, checksum (layout: analysis_file.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "analysis_file/analysis_file.h"

namespace scene_analyzer::analysis_file {

inline constexpr std::string_view kMagic = "SCNANLZ\n";
inline constexpr std::uint32_t kFormatVersion = 1;
inline constexpr std::size_t kHeaderBytes = 24;
inline constexpr std::size_t kChecksumBytes = 16;
// What protobuf can parse at once; also bounds the memory that a wrong file can ask for.
inline constexpr std::uint64_t kMaxFileBytes = 0x7FFFFFFF;

// The whole file for a payload.
std::string seal(std::string_view payload, std::uint32_t format_version = kFormatVersion);

// The payload within `bytes`, or why they are not a whole file of a known version. The checksum is compared
// before anything but magic and sizes is believed.
std::variant<std::string_view, Unusable> unseal(std::string_view bytes);

}  // namespace scene_analyzer::analysis_file
