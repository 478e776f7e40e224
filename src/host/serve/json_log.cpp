#include "serve/json_log.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <chrono>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace scene_analyzer::serve {
namespace {

// Messages of this logger are members of an object already.
constexpr std::string_view kObjects = "objects";

std::shared_ptr<spdlog::logger>& objects() {
  static std::shared_ptr<spdlog::logger> logger;  // only where the log is JSON
  return logger;
}

class JsonFormatter final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& line) override {
    const std::string_view payload(message.payload.data(), message.payload.size());
    const std::string_view logger(message.logger_name.data(), message.logger_name.size());
    const auto level = spdlog::level::to_string_view(message.level);
    const auto time = std::chrono::floor<std::chrono::milliseconds>(message.time);
    const auto milliseconds = (time - std::chrono::floor<std::chrono::seconds>(time)).count();
    fmt::format_to(std::back_inserter(line), R"({{"time":"{:%FT%T}.{:03}Z","level":"{}",)",
                   std::chrono::floor<std::chrono::seconds>(time), milliseconds,
                   std::string_view(level.data(), level.size()));
    if (logger == kObjects)
      line.append(payload.data(), payload.data() + payload.size());
    else
      fmt::format_to(std::back_inserter(line), R"("message":{})",
                     nlohmann::json(payload).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    line.append(std::string_view("}\n"));
  }
  std::unique_ptr<spdlog::formatter> clone() const override { return std::make_unique<JsonFormatter>(); }
};

}  // namespace

void set_up_json_logging(cli::LogLevel level) {
  cli::set_up_logging(level);
  const auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  sink->set_formatter(std::make_unique<JsonFormatter>());
  const auto make = [&, threshold = spdlog::default_logger()->level()](std::string name) {
    auto logger = std::make_shared<spdlog::logger>(std::move(name), sink);
    logger->set_level(threshold);
    logger->flush_on(spdlog::level::debug);
    return logger;
  };
  objects() = make(std::string(kObjects));
  auto logger = make("scene-analyzer");
  logger->set_formatter(std::make_unique<JsonFormatter>());
  spdlog::set_default_logger(std::move(logger));
}

void log_object(spdlog::level::level_enum level, std::string_view text, std::string_view members) {
  if (objects())
    objects()->log(level, "{}", members);
  else
    spdlog::log(level, "{}", cli::one_line(text));
}

}  // namespace scene_analyzer::serve
