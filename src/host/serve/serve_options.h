// serve_options.h — The arguments of `serve`.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "cli/logging.h"
#include "rpc/server.h"

namespace scene_analyzer::serve {

struct ServeRequest {
  bool help = false;  // nothing else is set then
  rpc::ServerOptions server;
  rpc::Limits limits;
  std::optional<std::string> metrics_address;
  std::optional<std::filesystem::path> store, root, token_file;
  std::uint64_t store_bytes = std::uint64_t{10} << 30;
  std::filesystem::path upload_folder;
  std::uint64_t upload_space = std::uint64_t{4} << 30;  // of all requests together
  std::size_t queue = 64;                               // requests at the same time
  unsigned jobs = 1;                                    // imports side by side
  std::chrono::seconds drain_timeout{30};
  std::string device;  // selector, "" = the preferred one
  cli::LogLevel log = cli::LogLevel::kNormal;
  bool json_log = false;
};

// Throws UsageError, also for an address that others can reach without TLS or --insecure.
ServeRequest parse_serve(std::span<const std::string> arguments);

std::string serve_help();

}  // namespace scene_analyzer::serve
