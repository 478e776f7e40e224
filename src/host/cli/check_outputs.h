// check_outputs.h — What `check` prints and writes.
#pragma once

#include "cli/check_options.h"
#include "gate/outputs.h"

namespace scene_analyzer::cli {

// Table, files and annotations, as far as they were asked for. Each is tried; logs what is wrong and returns
// whether all could be written.
bool write_check(const CheckRequest& request, const gate::CheckReport& report);

}  // namespace scene_analyzer::cli
