#include "import/file_names.h"

#include <string>
#include <string_view>
#include <system_error>

#include "base/error.h"
#include "files/file.h"

namespace scene_analyzer::import {
namespace {

std::string read_all(const std::filesystem::path& path) try {
  files::File file = files::File::open_regular(path);
  std::string bytes(static_cast<std::size_t>(file.size()), '\0');
  bytes.resize(file.read(bytes));
  return bytes;
} catch (const std::system_error& error) {
  throw std::system_error(error.code(), "the names of the asset's files cannot be read");
}

[[noreturn]] void refuse_damaged() {
  throw InputError("the names of the asset's files are damaged");
}

}  // namespace

void write_file_names(const std::filesystem::path& folder, const mesh::FileNames& names) {
  std::string bytes;
  for (const std::string& name : names) bytes.append(name).push_back('\0');
  files::File file = files::File::create(folder / kFileNames, 0600);
  file.write(bytes);
  file.close();
}

mesh::FileNames read_file_names(const std::filesystem::path& folder) {
  const std::string bytes = read_all(folder / kFileNames);
  mesh::FileNames names;
  for (std::string_view rest = bytes; !rest.empty();) {
    const std::size_t end = rest.find('\0');
    if (end == 0 || end == std::string_view::npos) refuse_damaged();
    names.emplace_back(rest.substr(0, end));
    rest.remove_prefix(end + 1);
  }
  if (names.empty()) refuse_damaged();
  return names;
}

}  // namespace scene_analyzer::import
