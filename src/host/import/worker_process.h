// worker_process.h — Runs the import worker and tells how it ended.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>

#include "import/import.h"

namespace scene_analyzer::import {

// The worker finds its answer's memory under this descriptor; 0 to 2 are /dev/null and nothing else is open.
inline constexpr int kAnswerDescriptor = 3;

// The worker crashed or exceeded a limit: one sentence without the asset's name.
class WorkerFailure : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// What the worker wrote, sealed against any further change and mapped for reading.
struct Answer {
  std::shared_ptr<const void> owner;
  std::span<const std::byte> memory;
};

// `limits` are already derived: memory_bytes > 0. Throws WorkerFailure, Stopped, and std::system_error
// when the machine cannot start a process.
Answer run_worker(const std::filesystem::path& asset, const Limits& limits, Textures textures);

}  // namespace scene_analyzer::import
