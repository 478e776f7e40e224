// temp_folder.h — What import_asset says about files in a temporary folder.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "import/import.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::import {

// Also writes below sub folders.
class TempFolder : public TemporaryFolder {
 public:
  std::filesystem::path write(const std::string& name, const std::string& contents) const {
    std::filesystem::create_directories((path() / name).parent_path());
    return TemporaryFolder::write(name, contents);
  }
};

// The message that the import ends with, "" when it does not.
inline std::string refusal(const std::filesystem::path& asset, const Limits& limits = {}) {
  try {
    import_asset(asset, limits);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline bool mentions(const std::vector<std::string>& sentences, std::string_view part) {
  for (const std::string& sentence : sentences)
    if (sentence.find(part) != std::string::npos) return true;
  return false;
}

}  // namespace scene_analyzer::import
