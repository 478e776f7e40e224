// import.h — Asset file -> mesh::Scene, through Assimp in a worker process.
//
// The worker is a small program beside this one or, where that is missing, this same program, started with a
// hidden first argument (kWorkerArgument); a file that crashes, hangs or eats memory in Assimp ends the
// worker, not the caller. Geometry comes back through shared memory and is validated (counts, index ranges,
// sizes) before anything uses it.
#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "base/error.h"
#include "mesh/asset_source.h"
#include "mesh/scene.h"

namespace scene_analyzer::import {

inline constexpr const char* kWorkerArgument = "--import-worker";

struct Limits {
  std::uint64_t memory_bytes = 0;  // address space of the worker; 0: derived from the file's size
  double seconds = 120;            // wall clock and CPU
  std::uint64_t triangles = 0;     // of all meshes, each counted once however often it is placed; 0: no limit
  std::stop_token stop = {};       // asked to stop, the worker is killed within a tenth of a second
};

// Thrown after Limits::stop; not a std::runtime_error, so that no handler of ordinary errors takes it.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "the import was stopped"; }
};

// The import took too long by the clock, or the system would not start it or ended it for lack of memory:
// with less going on beside it, it may succeed.
class EndedEarly : public InputError {
  using InputError::InputError;
};

// What becomes of base colour textures.
enum class Textures : std::uint8_t {
  kLeave,   // Texture::pixels stays empty
  kDecode,  // PNG, JPEG, BMP, TGA, GIF (its first picture) and PSD become pixels
};

// Reads `asset`, whose files may lie under other names (mesh/asset_source.h). Throws InputError naming the
// file and the reason: missing, a folder, empty, unsupported format, Assimp's own message, a missing .bin, a
// required glTF extension that is not on the tested list, a crash (signal name) or an exceeded limit;
// Stopped. An asset without any triangle is returned, not refused. Cost: linear in the file; the Scene's
// arrays live in the shared memory that the worker filled, no copy is made.
//
// Textures::kDecode: embedded textures, and files in the asset's folder, each once, one after the other,
// within the same limits; pictures of more than 16384 pixels a side or 64 Mi pixels are not tried. What
// cannot be decoded is one warning, never an exception: when the worker crashes or exceeds a limit, it is
// started once more, without textures. Cost: some 25 ms per million pixels of a file, twice that with 16 bits
// per channel; at most 4 MiB of shared memory per texture and 2 GiB in all; and while a picture is decoded,
// up to 20 bytes per pixel of the worker's memory.
mesh::Scene import_asset(const mesh::AssetSource& asset, const Limits& limits = {},
                         Textures textures = Textures::kLeave);

// Extensions of the formats that Assimp reads, in lower case, without a dot.
std::set<std::string, std::less<>> known_extensions();

// The extension of a file of that name, in lower case with its dot; "" where there is none, as such files are
// recognised by their contents. Throws InputError without the name when no format has it.
std::string known_extension_of(const std::filesystem::path& name);

// What this kernel does not offer to keep the worker in, one sentence each; empty where all is there.
std::vector<std::string> missing_isolation();

// Looks for the worker's program, which the first import does otherwise. A program that runs for long calls
// it at its start: a newer version that is installed meanwhile is not its worker.
void find_worker();

// The worker's main: called by main() when the first argument is kWorkerArgument. Returns the exit code.
int worker_main(int argc, char** argv);

}  // namespace scene_analyzer::import
