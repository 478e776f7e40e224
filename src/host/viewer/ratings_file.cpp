#include "viewer/ratings_file.h"

#include <fmt/format.h>

#include <system_error>

#include "base/error.h"
#include "files/file.h"
#include "files/replace.h"

namespace scene_analyzer::viewer {
namespace {

namespace fs = std::filesystem;

fs::path numbered(const fs::path& folder, std::string_view prefix, unsigned long number,
                  std::string_view suffix) {
  return folder / fmt::format("{}{}{}", prefix, number, suffix);
}

[[noreturn]] void fail(const fs::path& path, const std::error_code& reason) {
  throw InputError(fmt::format("cannot write {}: {}", path.string(), reason.message()));
}

// Whether the name is ours now: an empty file.
bool claim(const fs::path& path) {
  try {
    files::File::create(path).close();
    return true;
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::file_exists) return false;
    fail(path, error.code());
  }
}

}  // namespace

fs::path next_free_name(const fs::path& folder, std::string_view prefix, std::string_view suffix) {
  for (unsigned long number = 1;; ++number) {
    fs::path path = numbered(folder, prefix, number, suffix);
    std::error_code error;
    // A link that leads nowhere is a name that is taken, too.
    const fs::file_status status = fs::symlink_status(path, error);
    if (status.type() == fs::file_type::not_found) return path;
    if (error) fail(path, error);
  }
}

fs::path write_numbered(const fs::path& folder, std::string_view prefix, std::string_view suffix,
                        std::string_view bytes) {
  for (unsigned long number = 1;; ++number) {
    fs::path path = numbered(folder, prefix, number, suffix);
    if (!claim(path)) continue;
    try {
      files::replace(path, bytes);
      return path;
    } catch (const std::system_error& error) {
      std::error_code ignored;
      fs::remove(path, ignored);
      fail(path, error.code());
    }
  }
}

fs::path write_ratings(const report::SceneReport& report, const fs::path& folder) {
  return write_numbered(folder, "scene-ratings-", ".csv", report::csv(report));
}

}  // namespace scene_analyzer::viewer
