// codec.h — AssetAnalysis <-> bytes of the protobuf message scene_analyzer.v1.Analysis: the payload of
// analysis files, and what services send each other.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "analysis_file/analysis_file.h"

namespace scene_analyzer::analysis_file {

struct Stored {
  analysis::AssetAnalysis analysis;
  std::string version;  // of the program that measured
};

// content_key() of analysis_file.h for any program version.
std::string content_key_of(const analysis::AssetAnalysis& analysis, std::string_view version);

// The same analysis gives the same bytes. Throws InputError when it is larger than a file may be.
std::string encode(const analysis::AssetAnalysis& analysis, std::string_view version);

// Checks everything that the bytes claim, also under a right checksum: vocabulary, counts, ranges, indices,
// content key.
std::variant<Stored, Unusable> decode(std::string_view payload);

}  // namespace scene_analyzer::analysis_file
