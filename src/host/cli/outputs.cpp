#include "cli/outputs.h"

#include "base/error.h"
#include "cli/logging.h"

namespace scene_analyzer::cli {

void Outputs::attempt(const std::function<void()>& write) {
  try {
    write();
  } catch (const InputError& error) {
    log_error(error.what());
    good_ = false;
  }
}

}  // namespace scene_analyzer::cli
