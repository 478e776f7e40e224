#include "import/import.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cerrno>
#include <system_error>

#include "base/error.h"
#include "import/sandbox.h"
#include "import/scene_wire.h"
#include "import/text.h"
#include "import/wire.h"
#include "import/worker_process.h"

namespace scene_analyzer::import {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kGiB = std::uint64_t{1} << 30;
// Assimp's peak was at most 20 bytes per byte of any text format tried; archives may hold much more than
// their size.
constexpr std::uint64_t kBaseMemory = 4 * kGiB;
constexpr std::uint64_t kMemoryPerByte = 32;

std::uint64_t check_is_readable_file(const fs::path& asset) {
  std::error_code error;
  const fs::file_status status = fs::status(asset, error);
  if (status.type() == fs::file_type::not_found) throw InputError("no such file");
  if (error) throw InputError("cannot be read: " + error.message());
  if (fs::is_directory(status)) throw InputError("is a folder; name an asset file in it");
  if (!fs::is_regular_file(status)) throw InputError("is not a regular file");
  const int descriptor = ::open(asset.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) throw InputError("cannot be read: " + std::generic_category().message(errno));
  ::close(descriptor);
  const std::uint64_t bytes = fs::file_size(asset, error);
  if (error) throw InputError("cannot be read: " + error.message());
  if (bytes == 0) throw InputError("is empty");
  return bytes;
}

// The bulk of a .gltf lies beside it, also under a number.
std::uint64_t bytes_beside(const mesh::AssetSource& asset) {
  if (asset.file.extension() != ".gltf") return 0;
  std::uint64_t bytes = 0;
  std::error_code ignored;  // an unreadable folder only makes the limit tighter
  const fs::path folder = asset.file.has_parent_path() ? asset.file.parent_path() : ".";
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end; entry.increment(ignored))
    if ((asset.file_names || entry->path().extension() == ".bin") && entry->is_regular_file(ignored))
      bytes += entry->file_size(ignored);
  return bytes;
}

Limits derive(Limits limits, const mesh::AssetSource& asset, std::uint64_t asset_bytes) {
  if (limits.memory_bytes != 0) return limits;
  const auto machine = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                       static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  const std::uint64_t wanted = kBaseMemory + kMemoryPerByte * (asset_bytes + bytes_beside(asset));
  limits.memory_bytes = std::min(wanted, std::max(machine, kGiB));
  return limits;
}

mesh::Scene import_once(const mesh::AssetSource& asset, const Limits& limits, Textures textures) {
  const Answer answer = run_worker(asset, limits, textures);
  wire::Reader reader(answer.memory);
  if (reader.status() != wire::Status::kScene) throw InputError(clean_text(reader.string(), 2048));
  mesh::Scene scene = read_scene(reader);
  scene.asset = asset.name;
  scene.storage = answer.owner;
  scene.effort = answer.effort;
  return scene;
}

// Decoders of images are as easily crashed as importers; the geometry must not be lost with the textures.
mesh::Scene import_readable(const mesh::AssetSource& asset, const Limits& limits, Textures textures) {
  try {
    return import_once(asset, limits, textures);
  } catch (const WorkerFailure& error) {
    if (textures == Textures::kLeave) throw;
    mesh::Scene scene = import_once(asset, limits, Textures::kLeave);
    scene.warnings.push_back(std::string("no texture was decoded, as with textures ") + error.what());
    return scene;
  }
}

}  // namespace

std::set<std::string, std::less<>> known_extensions() {
  std::string list;
  Assimp::Importer().GetExtensionList(list);  // "*.3ds;*.obj"
  std::set<std::string, std::less<>> extensions;
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = std::min(list.find(';', begin), list.size());
    const std::string_view pattern = std::string_view(list).substr(begin, end - begin);
    if (pattern.starts_with("*.")) extensions.emplace(pattern.substr(2));
    begin = end + 1;
  }
  return extensions;
}

std::string known_extension_of(const fs::path& name) {
  std::string extension = name.extension().string();
  if (!extension.empty() && !Assimp::Importer().IsExtensionSupported(extension))
    throw InputError(
        "unsupported format \"" + clean_text(extension, 32) +
        "\"; supported are glTF, GLB, OBJ, PLY, STL, FBX, COLLADA (.dae), 3DS, 3MF, OFF, X, Blend and other "
        "formats of Assimp");
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return extension;
}

std::vector<std::string> missing_isolation() {
  std::vector<std::string> missing;
  const Offered offered = offered_by_kernel();
  if (!offered.landlock)
    missing.emplace_back(
        "this kernel offers no Landlock: what keeps the import worker to the asset's folder are the names "
        "alone, "
        "which are checked");
  if (!offered.seccomp)
    missing.emplace_back(
        "this kernel offers no seccomp: the import worker is not kept from the network and other processes");
  return missing;
}

mesh::Scene import_asset(const mesh::AssetSource& asset, const Limits& limits, Textures textures) {
  const std::string name = clean_text(asset.name, 4096);
  try {
    const std::uint64_t bytes = check_is_readable_file(asset.file);
    known_extension_of(asset.file);
    return import_readable(asset, derive(limits, asset, bytes), textures);
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what());
  } catch (const WorkerFailure& error) {
    if (error.machine_was_busy()) throw EndedEarly(name + ": " + error.what());
    throw InputError(name + ": " + error.what());
  } catch (const wire::Malformed& error) {
    throw InputError(name + ": the importer gave no usable answer: " + error.what());
  } catch (const std::system_error& error) {
    throw EndedEarly(name + ": the import worker could not be run: " + error.what());
  }
}

}  // namespace scene_analyzer::import
