// init_budget.h — A first budget for a team that has none: what there is passes, what gets worse does not.
#pragma once

#include <span>
#include <string>

#include "gate/asset_state.h"

namespace scene_analyzer::gate {

// A commented budget whose limits are the largest values of the assets, rounded up: counts and sizes to two
// digits, ratings to hundredths with room for other devices' last digits, rendering times with half as much
// again; defects are exact. Assets that could not be analysed are left out. What was not measured, and
// ratings that reach the end of their range, are not limited; the latter stand there as comments.
std::string init_budget(std::span<const AssetState> assets);

}  // namespace scene_analyzer::gate
