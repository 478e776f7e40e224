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
  if (const auto reason = implausible(analysis)) throw InputError(subject + *reason);
  try {
    const std::string bytes = seal(encode(analysis, version()));
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
    files::replace(file, bytes, {.folder_sync = files::FolderSync::kRequired});
  } catch (const InputError& error) {
    throw InputError(subject + error.what());
  } catch (const std::system_error& error) {
    throw InputError(subject + error.code().message() +
                     " (choose another folder with --cache-dir, or go without with --no-cache)");
  }
}

}  // namespace scene_analyzer::analysis_file
