// json_log.h — The log as JSON lines, for programs that collect it.
#pragma once

#include <spdlog/formatter.h>

#include <memory>

#include "cli/logging.h"

namespace scene_analyzer::serve {

// As cli::set_up_logging(), on standard error too; each message is an object of its own with "time" (UTC, RFC
// 3339), "level" and "message", and the members of the log's object where the message was logged by
// log_object().
void set_up_json_logging(cli::LogLevel level);

// `members`: JSON members without braces, `"code":"OK","seconds":0.1`; in text logs `text` stands for them.
void log_object(spdlog::level::level_enum level, std::string_view text, std::string_view members);

}  // namespace scene_analyzer::serve
