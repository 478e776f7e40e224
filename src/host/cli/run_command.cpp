#include "cli/run_command.h"

#include <fmt/format.h>

#include <exception>
#include <string>

#include "base/error.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/logging.h"
#include "cli/run_state.h"
#include "gpu/error.h"
#include "import/import.h"
#include "window/window.h"

namespace scene_analyzer::cli {
namespace {

int report_error(int code, const std::exception& error, const std::string& remedy = "") {
  log_error(fmt::format("{}{}", error.what(), remedy));
  return code;
}

int run(const std::function<int()>& command) {
  try {
    return command();
  } catch (const import::Stopped&) {
    check_interrupt();  // which is what has stopped it
    throw;
  }
}

}  // namespace

int run_command(const std::function<int()>& command) {
  set_up_logging(LogLevel::kNormal);  // until the command knows better
  try {
    return run(command);
  } catch (const UsageError& error) {
    return report_error(kUnusable, error);
  } catch (const InputError& error) {
    return report_error(kInputFailed, error);
  } catch (const gpu::NoDevice& error) {
    return report_error(
        kUnusable, error,
        "; 'scene-analyzer devices' lists what is there, and the package mesa-vulkan-drivers brings a "
        "device that runs on the processor");
  } catch (const gpu::DeviceLost& error) {
    const std::string state = describe_run_state();
    return report_error(kUnusable, error, state.empty() ? "" : " The run has ended " + state);
  } catch (const gpu::OutOfMemory& error) {
    return report_error(
        kUnusable, error,
        "; close other programs that use the device, analyse fewer assets at once or choose another "
        "device with --device");
  } catch (const gpu::Error& error) {
    return report_error(kUnusable, error);
  } catch (const window::NoDisplay& error) {
    return report_error(kUnusable, error,
                        "; without a display, 'scene-analyzer analyze FILE --image FILE.png' draws pictures");
  } catch (const Interrupted& stop) {
    say_stopped();
    return stop.exit_code();
  } catch (const std::exception& error) {
    return report_error(kUnusable, error, " (a defect of scene-analyzer; please report it with the command)");
  }
}

}  // namespace scene_analyzer::cli
