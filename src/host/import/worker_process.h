// worker_process.h — Runs the import worker and tells how it ended.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "import/import.h"
#include "mesh/asset_source.h"
#include "mesh/scene.h"

namespace scene_analyzer::import {

// The worker finds its answer's memory under this descriptor; 0 to 2 are /dev/null and nothing else is open.
inline constexpr int kAnswerDescriptor = 3;

// The worker crashed or exceeded a limit: one sentence without the asset's name.
class WorkerFailure : public std::runtime_error {
 public:
  explicit WorkerFailure(const std::string& what, bool machine_was_busy = false)
      : std::runtime_error(what), machine_was_busy_(machine_was_busy) {}
  // Whether it may end better with less going on beside it.
  bool machine_was_busy() const { return machine_was_busy_; }

 private:
  bool machine_was_busy_;
};

// What the worker wrote, sealed against any further change and mapped for reading.
struct Answer {
  std::shared_ptr<const void> owner;
  std::span<const std::byte> memory;
  mesh::ImportEffort effort;
};

// `limits` are already derived: memory_bytes > 0. Throws WorkerFailure, Stopped, and std::system_error
// when the machine cannot start a process.
Answer run_worker(const mesh::AssetSource& asset, const Limits& limits, Textures textures);

}  // namespace scene_analyzer::import
