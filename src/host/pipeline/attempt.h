// attempt.h — What is wrong with one asset becomes its outcome. Inside this room only.
#pragma once

#include <filesystem>
#include <functional>

#include "pipeline/pipeline.h"

namespace scene_analyzer::pipeline {

// Runs a step of an asset's analysis; what is wrong with the asset goes into its outcome. Everything else,
// such as a lost device, is thrown on.
void attempt(const mesh::AssetSource& asset, Outcome& outcome, const std::function<void()>& step);

}  // namespace scene_analyzer::pipeline
