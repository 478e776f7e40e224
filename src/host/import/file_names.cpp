#include "import/file_names.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "files/file.h"

namespace scene_analyzer::import {

void write_file_names(const std::filesystem::path& folder, const mesh::FileNames& names) {
  std::string bytes;
  for (const std::string& name : names) bytes.append(name).push_back('\0');
  files::File file = files::File::create(folder / kFileNames, 0600);
  file.write(bytes);
  file.close();
}

mesh::FileNames read_file_names(const std::filesystem::path& folder) {
  files::File file = files::File::open_regular(folder / kFileNames);
  std::string bytes(static_cast<std::size_t>(file.size()), '\0');
  bytes.resize(file.read(bytes));
  mesh::FileNames names;
  for (std::string_view rest = bytes; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\0'), rest.size() - 1);
    names.emplace_back(rest.substr(0, end));
    rest.remove_prefix(end + 1);
  }
  return names;
}

}  // namespace scene_analyzer::import
