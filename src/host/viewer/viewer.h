// viewer.h — The review window: a scene in the colours of its ratings, to walk around in.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "pipeline/pipeline.h"

namespace scene_analyzer::viewer {

struct ViewerOptions {
  std::vector<std::filesystem::path> assets;  // at least one
  pipeline::Options pipeline;
  gpu::DeviceOptions device;
  int width = 1280, height = 720;  // of the window, in the desktop's units
  std::filesystem::path folder;    // where ratings and pictures are written; empty: the working folder
  std::function<void(const std::string&)> warn;   // messages for the terminal
  std::function<void(const std::string&)> print;  // what was asked for: keys
  std::function<void(const std::string&)> tell;   // at the end: how fluently it moved
};

// Opens a window and returns when it was closed: whether all assets could be analysed. Idle, it draws
// nothing. Throws window::NoDisplay, gpu::NoDevice, gpu::DeviceLost, gpu::Error.
bool run_viewer(const ViewerOptions& options);

}  // namespace scene_analyzer::viewer
