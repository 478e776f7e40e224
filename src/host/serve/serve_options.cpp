#include "serve/serve_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>
#include <system_error>
#include <thread>

#include "base/error.h"
#include "cli/command_line.h"
#include "cli/measuring_options.h"
#include "cli/option_parsing.h"

namespace scene_analyzer::serve {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostQueued = 4096;
constexpr std::uint64_t kMostJobs = 1024;
constexpr double kLongestDrain = 86400;
constexpr double kLongestSilence = 86400;
constexpr std::uint64_t kLeastSpace = 1 << 20;  // of uploads

constexpr const char* kPurpose =
    "Analyses, rates and draws assets for programs that are not on this machine, over gRPC. The calls are\n"
    "described in proto/scene_analyzer/v1/service.proto, clients in docs/service.md. Requests of several\n"
    "clients share the device; what was analysed before is answered from the store.\n";

constexpr const char* kSignals =
    "Signals:\n"
    "  SIGTERM, SIGINT  take no more requests, finish those that were taken, end; a second one ends at once\n"
    "  SIGHUP           read --token-file again\n";

constexpr const char* kExamples =
    "Examples:\n"
    "  scene-analyzer serve\n"
    "  scene-analyzer serve --store /var/lib/scene-analyzer --root /srv/assets --metrics-listen "
    "127.0.0.1:9464\n"
    "  scene-analyzer serve --listen 0.0.0.0:50051 --tls-cert chain.pem --tls-key key.pem --token-file "
    "tokens\n";

constexpr const char* kServeExitCodes =
    "Exit codes:\n"
    "  0  ended by a signal, in order\n"
    "  2  wrong options, no usable device, an address that is taken, or an error of the program\n"
    "  130, 143  ended at once by a second signal\n";

cli::Options make_options() {
  cli::Options options("scene-analyzer serve", kPurpose);
  options.add(
      "Network",
      {
          {"listen", "where to listen, default 127.0.0.1:50051; port 0: any free one, which is logged",
           "ADDR:PORT"},
          {"tls-cert", "PEM file with the certificate, and those between it and its authority", "FILE"},
          {"tls-key", "PEM file with the key of that certificate", "FILE"},
          {"client-ca",
           "clients need certificates that an authority in this PEM file has signed (mutual TLS)", "FILE"},
          {"insecure",
           "listen without TLS at an address that other machines can reach: everybody on the way can "
           "read and change what is sent"},
          {"token-file",
           "clients need one of these tokens, one per line of at least 16 characters, as 'authorization: "
           "Bearer TOKEN'; read again on SIGHUP",
           "FILE"},
          {"metrics-listen",
           "answer http://ADDR:PORT/metrics for Prometheus, without TLS or tokens; default not at all",
           "ADDR:PORT"},
      });
  options.add(
      "Files",
      {
          {"store", "keep analyses in DIR, by their contents; default nowhere", "DIR"},
          {"store-size", "of all analyses in the store, default 10G; those used longest ago go first",
           "SIZE"},
          {"root", "let clients name assets below DIR in place of sending them", "DIR"},
          {"upload-dir", "where uploads are kept while they are needed, default $TMPDIR or /tmp", "DIR"},
      });
  options.add(
      "Limits",
      {
          {"queue", "requests that are taken at the same time, default 64; others are told to try again",
           "N"},
          {"max-upload", "of all files of one request together, default 1G", "SIZE"},
          {"upload-space", "of the uploads of all requests together, default 4G", "SIZE"},
          {"silence", "seconds after which a client that neither sends nor reads is cut off, default 60",
           "S"},
          {"timing-budget", "seconds that timing the rendering of one asset may take, default 30", "S"},
          {"max-start-searches",
           "most work on the Fourier transform's start triangles that a request may ask for, in walks over a "
           "part of a mesh, default 20000",
           "N"},
          {"drain-timeout", "seconds that requests have to end after SIGTERM, default 30", "S"},
          {"jobs", "assets read at the same time, beside the measuring; default one per processor", "N"},
      });
  cli::add_device_options(options);
  options.add("Messages", {{"log-format", "text (default), or json: one object per line", "FORMAT"}});
  cli::add_common_options(options);
  return options;
}

// "host:port", the host perhaps in brackets.
void check_address(const char* option, const std::string& address) {
  const std::size_t colon = address.rfind(':');
  const std::string_view host = std::string_view(address).substr(0, colon);
  const bool bare_v6 = host.find(':') != std::string_view::npos && !host.starts_with('[');
  if (colon == std::string::npos || host.empty() || bare_v6)
    throw UsageError(fmt::format("--{}: '{}' is no address; write for example 127.0.0.1:50051 or [::1]:50051",
                                 option, address));
  cli::parse_integer(option, address.substr(colon + 1), 0, 65535);
}

void read_network(const cli::CommandLine& line, ServeRequest& request) {
  if (const auto address = line.value("listen")) request.server.address = *address;
  check_address("listen", request.server.address);
  request.metrics_address = line.value("metrics-listen");
  if (request.metrics_address) check_address("metrics-listen", *request.metrics_address);
  request.token_file = line.value("token-file");
  const auto certificate = line.value("tls-cert"), key = line.value("tls-key"), ca = line.value("client-ca");
  if (certificate.has_value() != key.has_value())
    throw UsageError("--tls-cert and --tls-key belong together; one of them is missing");
  if (ca && !certificate) throw UsageError("--client-ca needs --tls-cert and --tls-key");
  if (certificate) request.server.tls = rpc::Tls{*certificate, *key, {}};
  if (ca) request.server.tls->client_ca = *ca;
  if (certificate && line.flag("insecure"))
    throw UsageError("--insecure and --tls-cert contradict each other; leave one of them out");
  if (!certificate && !line.flag("insecure") && !rpc::is_loopback(request.server.address))
    throw UsageError(
        fmt::format("--listen: other machines can reach '{}', and nothing would be encrypted; add --tls-cert "
                    "and --tls-key, or "
                    "--insecure where the network itself is trusted",
                    request.server.address));
}

std::chrono::seconds read_seconds(const cli::CommandLine& line, const char* option, double most,
                                  std::chrono::seconds otherwise) {
  const auto text = line.value(option);
  if (!text) return otherwise;
  return std::chrono::seconds(cli::parse_integer(option, *text, 1, static_cast<std::uint64_t>(most)));
}

void read_files(const cli::CommandLine& line, ServeRequest& request) {
  request.store = cli::read_folder(line, "store");
  request.root = cli::read_folder(line, "root");
  if (const auto size = line.value("store-size")) {
    if (!request.store) throw UsageError("--store-size goes with --store");
    request.store_bytes = cli::parse_size("store-size", *size);
  }
  std::error_code error;
  request.upload_folder = cli::read_folder(line, "upload-dir").value_or(fs::temp_directory_path(error));
  if (request.upload_folder.empty())
    throw UsageError(fmt::format("there is no folder for temporary files: {}; name one with --upload-dir",
                                 error.message()));
}

std::uint64_t read_space(const cli::CommandLine& line, const char* option, std::uint64_t otherwise) {
  const auto text = line.value(option);
  if (!text) return otherwise;
  const std::uint64_t bytes = cli::parse_size(option, *text);
  if (bytes < kLeastSpace) throw UsageError(fmt::format("--{}: '{}' is less than 1M", option, *text));
  return bytes;
}

void read_limits(const cli::CommandLine& line, ServeRequest& request) {
  if (const auto queue = line.value("queue"))
    request.queue = static_cast<std::size_t>(cli::parse_integer("queue", *queue, 1, kMostQueued));
  request.server.admitted_calls = static_cast<int>(request.queue);
  request.limits.upload_bytes = read_space(line, "max-upload", request.limits.upload_bytes);
  request.upload_space = read_space(line, "upload-space", request.upload_space);
  if (request.upload_space < request.limits.upload_bytes) {
    if (line.value("max-upload"))
      throw UsageError("--max-upload is more than --upload-space, which has to hold at least one upload");
    request.limits.upload_bytes = request.upload_space;
  }
  request.limits.silence = read_seconds(line, "silence", kLongestSilence, request.limits.silence);
  request.drain_timeout = read_seconds(line, "drain-timeout", kLongestDrain, request.drain_timeout);
  if (const auto budget = line.value("timing-budget"))
    request.limits.timing_budget = cli::parse_number("timing-budget", *budget, 0.001, 86400, "seconds");
  if (const auto searches = line.value("max-start-searches"))
    request.limits.start_searches =
        cli::parse_integer("max-start-searches", *searches, 1, std::numeric_limits<std::uint32_t>::max());
  request.jobs = std::max(1U, std::thread::hardware_concurrency());
  if (const auto jobs = line.value("jobs"))
    request.jobs = static_cast<unsigned>(cli::parse_integer("jobs", *jobs, 1, kMostJobs));
}

}  // namespace

ServeRequest parse_serve(std::span<const std::string> arguments) {
  cli::Options options = make_options();
  const cli::CommandLine line(options, arguments);
  ServeRequest request;
  request.help = line.flag("help");
  if (request.help) return request;
  request.log = cli::log_level(line.flag("quiet"), line.flag("verbose"));
  if (!line.positional().empty())
    throw UsageError(
        fmt::format("'{}' is not understood; clients name or send the assets", line.positional()[0]));
  read_network(line, request);
  read_files(line, request);
  read_limits(line, request);
  pipeline::Options pipeline;
  request.device = cli::read_device(line, pipeline);
  request.limits.import = pipeline.import_limits;
  const std::string format = line.value("log-format").value_or("text");
  if (format != "text" && format != "json")
    throw UsageError(fmt::format("--log-format: '{}' is neither text nor json", format));
  request.json_log = format == "json";
  return request;
}

std::string serve_help() {
  return fmt::format("{}\n{}\n{}\n{}",
                     make_options().help({"Network", "Files", "Limits", "Running", "Messages"}), kSignals,
                     kExamples, kServeExitCodes);
}

}  // namespace scene_analyzer::serve
