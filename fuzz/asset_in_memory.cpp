#include "asset_in_memory.h"

#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "import/mapped_file.h"

namespace scene_analyzer::fuzz {
namespace {

namespace fs = std::filesystem;

std::string_view asset;

class Folder {
 public:
  Folder() : path_((fs::temp_directory_path() / "scene-analyzer-fuzz-XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) throw std::runtime_error("no temporary folder: " + path_);
    fs::current_path(path_);
    std::ofstream("b.bin") << std::string(60, '\0');
  }
  ~Folder() {
    std::error_code ignored;
    fs::current_path("/", ignored);
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

 private:
  std::string path_;
};

}  // namespace

void set_asset(std::string_view bytes) {
  asset = bytes;
}

void enter_folder() {
  static const Folder folder;
}

}  // namespace scene_analyzer::fuzz

namespace scene_analyzer::import {

MappedFile::MappedFile(const std::string& /*path*/) {
  const std::string_view text = fuzz::asset;
  if (text.empty()) return;
  auto* copy = new std::uint8_t[text.size()];
  std::copy(text.begin(), text.end(), copy);
  bytes_ = {copy, text.size()};
}

MappedFile::~MappedFile() {
  delete[] bytes_.data();
}

}  // namespace scene_analyzer::import
