#include <system_error>

#include "analysis_file/analysis_file.h"
#include "analysis_file/codec.h"
#include "analysis_file/envelope.h"
#include "analysis_file/plausible.h"
#include "base/error.h"
#include "base/version.h"
#include "files/replace.h"

namespace scene_analyzer::analysis_file {

void store(const std::filesystem::path& file, const analysis::AssetAnalysis& analysis) {
  const std::string subject = "analysis file '" + file.string() + "' cannot be written: ";
  if (const auto reason = implausible(analysis)) throw CannotStore(subject + *reason, true);
  try {
    const std::string bytes = seal(encode(analysis, version()));
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
    files::replace(file, bytes, {.folder_sync = files::FolderSync::kRequired});
  } catch (const InputError& error) {
    throw CannotStore(subject + error.what(), true);
  } catch (const std::system_error& error) {
    const bool is_the_name = error.code() == std::errc::filename_too_long;
    throw CannotStore(subject + error.code().message(), is_the_name);
  }
}

}  // namespace scene_analyzer::analysis_file
