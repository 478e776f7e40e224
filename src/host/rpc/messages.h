// messages.h — Results as messages.
#pragma once

#include <span>
#include <string>

#include "analysis/analysis.h"
#include "gpu/device.h"
#include "ratings/ratings.h"
#include "scene_analyzer/v1/service.pb.h"

namespace scene_analyzer::rpc {

// What an analysis file would hold. Throws InputError for what is larger than one may be.
v1::Analysis to_message(const analysis::AssetAnalysis& analysis);

// Checked like a file from elsewhere. Throws service::Refusal (kInvalid); `where` is for its message.
analysis::AssetAnalysis from_message(const v1::Analysis& message, const std::string& where);

v1::RateResponse to_message(const ratings::SceneRating& rating);

v1::Device to_message(const gpu::DeviceInfo& device, bool in_use);

}  // namespace scene_analyzer::rpc
