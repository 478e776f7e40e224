#include "service/root_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <string>
#include <system_error>

#include "base/error.h"
#include "service/refusal.h"

namespace scene_analyzer::service {

namespace fs = std::filesystem;

RootFolder::RootFolder(const fs::path& folder) {
  std::error_code error;
  folder_ = fs::canonical(folder, error);
  if (error)
    throw UsageError(fmt::format("--root: '{}' cannot be read: {}", folder.string(), error.message()));
  if (!fs::is_directory(folder_, error) || ::access(folder_.c_str(), R_OK | X_OK) != 0)
    throw UsageError(fmt::format("--root: '{}' is no folder that can be read", folder.string()));
}

mesh::AssetSource RootFolder::find(std::string_view name) const {
  const auto missing = [&] {
    return Refusal(Reason::kNotFound, fmt::format("'{}' is no asset below the service's --root",
                                                  name.substr(0, name.find('\0'))));
  };
  if (name.empty() || name.find('\0') != std::string_view::npos || fs::path(name).is_absolute())
    throw missing();
  // Step by step: a way that leads out and back in would tell what lies outside.
  std::error_code error;
  fs::path place = folder_;
  for (const fs::path& part : fs::path(name)) {
    place = fs::canonical(place / part, error);
    if (error || *place.lexically_relative(folder_).begin() == "..") throw missing();
  }
  if (!fs::is_regular_file(place, error)) throw missing();
  return {place, place.lexically_relative(folder_).generic_string()};
}

}  // namespace scene_analyzer::service
