// host_memory.h — What a CPU device consists of: how much main memory this process may still take, and the
// processor.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace scene_analyzer::gpu {

// The smaller of the machine's available memory and what the control groups of this process (containers,
// batch schedulers) leave. Absent where the system tells neither.
std::optional<std::uint64_t> free_host_memory_bytes();

// The bytes behind `MemAvailable:` of a /proc/meminfo text.
std::optional<std::uint64_t> available_bytes_of_meminfo(const std::string& text);

// "AMD EPYC 7763 64-Core Processor", as the system calls it.
std::string processor_name();

}  // namespace scene_analyzer::gpu
