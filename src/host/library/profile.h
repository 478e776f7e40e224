// profile.h — The assets of a shard through the pipeline: imports side by side, small meshes of many assets
// together on the device, one record per asset.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "gpu/device.h"
#include "library/journal.h"
#include "pipeline/pipeline.h"

namespace scene_analyzer::library {

struct ProfileOptions {
  pipeline::Options pipeline;    // its cache folder is analyses_folder()
  std::filesystem::path folder;  // of the output
  unsigned jobs = 1;             // imports side by side
  // Of scenes that wait for the device, besides those being imported; a larger one waits alone.
  std::uint64_t most_bytes = std::uint64_t{1} << 30;
};

struct ProfileEvents {
  // After each asset, from the calling thread: its record, and whether its analysis file served.
  std::function<void(const Record& record, bool unchanged)> finished;
  // Between steps and at least a few times a second; what it throws ends the run.
  std::function<void()> check;
  // A device, which has lost the former one if there was one. Called from any thread, never twice at once.
  std::function<gpu::Device&()> device;
};

struct ProfileResult {
  std::uint64_t analysed = 0, unchanged = 0;  // unchanged: of those analysed
  std::uint64_t incomplete = 0, failed = 0;
};

// Analyses `assets` and adds a record of each to `journal`. What is wrong with one asset is its record; what
// may have been the fault of those beside it is tried again alone, and so is what was measured when the
// device was lost. Throws UsageError when the output folder cannot be written, gpu::DeviceLost when devices
// are lost time and again, gpu::NoDevice, import::Stopped and what ProfileEvents::check throws. Memory:
// most_bytes, the scenes that are being imported and measured, and a record per asset.
ProfileResult profile(std::span<const std::string> assets, const ProfileOptions& options, Journal& journal,
                      const ProfileEvents& events);

}  // namespace scene_analyzer::library
