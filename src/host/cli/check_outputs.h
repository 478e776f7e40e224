// check_outputs.h — What `check` prints and writes.
#pragma once

#include "cli/check_options.h"
#include "cli/outputs.h"
#include "gate/outputs.h"

namespace scene_analyzer::cli {

// Table, files and annotations, as far as they were asked for.
void write_check(const CheckRequest& request, const gate::CheckReport& report, Outputs& outputs);

}  // namespace scene_analyzer::cli
