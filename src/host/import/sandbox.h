// sandbox.h — What the worker gives up before it touches the asset.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>

namespace scene_analyzer::import {

// What the kernel offers beyond limits of resources.
struct Offered {
  bool landlock = false;  // files: reading below one folder, nothing else
  bool seccomp = false;   // calls: no network, no process, no signal, nothing written but the answer
};
Offered offered_by_kernel() noexcept;

// Address space, CPU seconds, size of the answer, no core file; dies with `parent`. Under AddressSanitizer,
// whose shadow needs terabytes, address space stays unlimited. Throws std::system_error.
void limit_this_process(std::uint64_t memory_bytes, std::uint64_t cpu_seconds, pid_t parent);

// From here on only reading below `folder`, and of `asset` itself, which may be a link. Where the kernel has
// no Landlock the names are still checked by AssetFiles. Throws std::system_error.
void allow_reading_only(const std::filesystem::path& folder, const std::filesystem::path& asset);

// From here on the system refuses (EACCES) sockets, other programs and processes, signals to others, and
// opening or changing files for anything but reading; what is open stays usable. Nothing happens where the
// kernel has no seccomp. Throws std::system_error.
void allow_computing_only();

}  // namespace scene_analyzer::import
