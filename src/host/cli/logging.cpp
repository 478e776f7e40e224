#include "cli/logging.h"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <unistd.h>

#include <memory>

#include "base/error.h"
#include "cli/terminal.h"

namespace scene_analyzer::cli {

LogLevel log_level(bool quiet, bool verbose) {
  if (quiet && verbose)
    throw UsageError("--quiet and --verbose contradict each other; leave one of them out");
  return quiet ? LogLevel::kQuiet : verbose ? LogLevel::kVerbose : LogLevel::kNormal;
}

void set_up_logging(LogLevel level) {
  const auto mode = wants_color(STDERR_FILENO) ? spdlog::color_mode::always : spdlog::color_mode::never;
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(mode);
  auto logger = std::make_shared<spdlog::logger>("scene-analyzer", std::move(sink));
  logger->set_pattern("%^%l%$: %v");
  logger->set_level(level == LogLevel::kQuiet     ? spdlog::level::err
                    : level == LogLevel::kVerbose ? spdlog::level::debug
                                                  : spdlog::level::info);
  logger->flush_on(spdlog::level::debug);
  spdlog::set_default_logger(std::move(logger));
}

std::string one_line(std::string_view text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.remove_suffix(1);
  std::string line;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto following = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (text[i] == '\n' || text[i] == '\t') {
      line += ' ';
    } else if (byte < 0x20 || byte == 0x7f) {
      line += fmt::format("\\x{:02x}", byte);
    } else if (byte == 0xc2 && following >= 0x80 && following < 0xa0) {  // the C1 controls in UTF-8
      line += fmt::format("\\xc2\\x{:02x}", following);
      ++i;
    } else {
      line += text[i];
    }
  }
  return line;
}

}  // namespace scene_analyzer::cli
