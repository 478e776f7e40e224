// import.h — Asset file -> mesh::Scene, through Assimp in a worker process.
//
// The worker is this same program, re-executed with a hidden first argument (kWorkerArgument); a file that
// crashes, hangs or eats memory in Assimp ends the worker, not the caller. Geometry comes back through shared
// memory and is validated (counts, index ranges, sizes) before anything uses it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "mesh/scene.h"

namespace scene_analyzer::import {

inline constexpr const char* kWorkerArgument = "--import-worker";

struct Limits {
  std::uint64_t memory_bytes = 0;  // address space of the worker; 0: derived from the file's size
  double seconds = 120;            // wall clock and CPU
};

// Reads `asset`. Throws InputError naming the file and the reason: missing, a folder, empty, unsupported
// format, Assimp's own message, a missing .bin, a required glTF extension that is not on the tested list, a
// crash (signal name) or an exceeded limit. An asset without any triangle is returned, not refused. Cost:
// linear in the file; the Scene's arrays live in the shared memory that the worker filled, no copy is made.
mesh::Scene import_asset(const std::filesystem::path& asset, const Limits& limits = {});

// The worker's main: called by main() when the first argument is kWorkerArgument. Returns the exit code.
int worker_main(int argc, char** argv);

}  // namespace scene_analyzer::import
