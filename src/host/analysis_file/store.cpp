#include <unistd.h>

#include <cstdio>
#include <random>
#include <system_error>

#include "analysis_file/analysis_file.h"
#include "analysis_file/codec.h"
#include "analysis_file/envelope.h"
#include "analysis_file/file_io.h"
#include "analysis_file/hash.h"
#include "analysis_file/little_endian.h"
#include "analysis_file/plausible.h"
#include "analysis_file/temporary_name.h"
#include "base/error.h"
#include "base/version.h"

namespace scene_analyzer::analysis_file {
namespace {

constexpr int kNameAttempts = 16;

// Removes the temporary file unless it was renamed.
class Temporary {
 public:
  explicit Temporary(std::filesystem::path path) : path_(std::move(path)), file_(File::create(path_)) {}
  ~Temporary() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void fill(std::string_view bytes) {
    file_.write(bytes);
    file_.sync();
    file_.close();
  }
  void rename_to(const std::filesystem::path& place) {
    if (::rename(path_.c_str(), place.c_str()) != 0) throw std::system_error(errno, std::generic_category());
    path_.clear();
  }

 private:
  std::filesystem::path path_;
  File file_;
};

void write_once(const std::filesystem::path& file, std::string_view bytes) {
  const std::filesystem::path folder = file.parent_path();
  Temporary temporary(folder / temporary_name());
  temporary.fill(bytes);
  temporary.rename_to(file);
  try {
    sync_folder(folder);
  } catch (const std::system_error&) {
    ::unlink(file.c_str());  // an error means that nothing was stored, also after the next power failure
    throw;
  }
}

void write_atomically(const std::filesystem::path& file, std::string_view bytes) {
  for (int attempt = 1;; ++attempt) {
    try {
      return write_once(file, bytes);
    } catch (const std::system_error& error) {
      if (error.code() != std::errc::file_exists || attempt == kNameAttempts) throw;
    }
  }
}

}  // namespace

std::string temporary_name() {
  std::random_device random;
  std::string noise;
  append(noise, static_cast<std::uint64_t>(::getpid()));
  for (int i = 0; i < 4; ++i) append(noise, static_cast<std::uint32_t>(random()));
  return std::string(kTemporaryPrefix) + to_hex(hash_of(noise)) + std::string(kTemporarySuffix);
}

void store(const std::filesystem::path& file, const analysis::AssetAnalysis& analysis) {
  const std::string subject = "analysis file '" + file.string() + "' cannot be written: ";
  if (const auto reason = implausible(analysis)) throw InputError(subject + *reason);
  try {
    const std::string bytes = seal(encode(analysis, version()));
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
    write_atomically(file, bytes);
  } catch (const InputError& error) {
    throw InputError(subject + error.what());
  } catch (const std::system_error& error) {
    throw InputError(subject + error.code().message() +
                     " (choose another folder with --cache-dir, or go without with --no-cache)");
  }
}

}  // namespace scene_analyzer::analysis_file
