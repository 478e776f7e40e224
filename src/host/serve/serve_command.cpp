#include "serve/serve_command.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <optional>

#include "cli/exit_code.h"
#include "cli/lazy_device.h"
#include "cli/logging.h"
#include "import/import.h"
#include "serve/blocked_signals.h"
#include "serve/json_log.h"
#include "serve/running_service.h"
#include "serve/serve_options.h"

namespace scene_analyzer::serve {
namespace {

using namespace std::chrono_literals;

// The signal that is to end the service.
int wait_for_end(const BlockedSignals& signals, RunningService& service) {
  while (true) {
    const int signal = signals.wait();
    if (signal != SIGHUP) return signal;
    service.reload_tokens();
  }
}

// Lets those finish who have been let in. Returns the second signal, if one came.
std::optional<int> drain(const BlockedSignals& signals, RunningService& service, std::chrono::seconds time) {
  service.begin_to_drain();
  cli::log_note(
      fmt::format("no more requests are taken; those that were taken have {} s to end", time.count()));
  const auto deadline = std::chrono::steady_clock::now() + time;
  while (!service.wait_for_answers(20ms)) {
    const auto signal = signals.wait_for(0ms);
    if (signal && *signal != SIGHUP) return signal;
    if (std::chrono::steady_clock::now() < deadline) continue;
    cli::log_warning("requests that have not ended in time are cancelled (--drain-timeout)");
    return std::nullopt;
  }
  service.hang_up();
  return std::nullopt;
}

// As many as this process is allowed: every client, and every file that it sends, takes one.
void allow_many_files() {
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0 || files.rlim_cur == files.rlim_max) return;
  files.rlim_cur = files.rlim_max;
  if (::setrlimit(RLIMIT_NOFILE, &files) != 0)
    cli::log_warning("the limit of open files stays as low as it is; many clients at once may be refused");
}

int serve(const ServeRequest& request, const BlockedSignals& signals, cli::LazyDevice& device) {
  RunningService service(request, device);
  cli::log_note(fmt::format("listening on {} ({}); analyses are computed on {}", service.address(),
                            request.server.tls ? "TLS" : "not encrypted", service.device_name()));
  wait_for_end(signals, service);
  const std::optional<int> second = drain(signals, service, request.drain_timeout);
  return second ? 128 + *second : static_cast<int>(cli::kSuccess);
}

}  // namespace

int serve_command(std::span<const std::string> arguments) {
  const ServeRequest request = parse_serve(arguments);
  if (request.help) {
    fmt::print("{}", serve_help());
    return cli::kSuccess;
  }
  request.json_log ? set_up_json_logging(request.log) : cli::set_up_logging(request.log);
  const BlockedSignals signals({SIGTERM, SIGINT, SIGHUP});
  std::signal(SIGPIPE, SIG_IGN);  // clients may leave at any time
  import::find_worker();
  allow_many_files();
  for (const std::string& missing : import::missing_isolation()) cli::log_warning(missing);
  cli::LazyDevice device(cli::device_options(request.device));
  const int code = serve(request, signals, device);
  const auto validation = device.take_validation_messages();
  for (const std::string& message : validation) cli::log_error(message);
  return validation.empty() ? code : static_cast<int>(cli::kUnusable);
}

}  // namespace scene_analyzer::serve
