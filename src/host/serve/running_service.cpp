#include "serve/running_service.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <system_error>

#include "base/error.h"
#include "rpc/grpc_log.h"
#include "serve/json_log.h"

namespace scene_analyzer::serve {
namespace {

// As members of a JSON object, without its braces.
std::string members_of(const rpc::CallRecord& call) {
  const nlohmann::ordered_json object = {{"message", fmt::format("{} {}", call.method, call.code)},
                                         {"request_id", call.request_id},
                                         {"method", call.method},
                                         {"peer", call.peer},
                                         {"asset", call.asset},
                                         {"upload_bytes", call.upload_bytes},
                                         {"from_store", call.from_store},
                                         {"code", call.code},
                                         {"reason", call.message},
                                         {"seconds", call.seconds}};
  const std::string text = object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return text.substr(1, text.size() - 2);
}

// "Analyze OK in 0.123 s (room.glb, 4096 bytes sent, from the store; peer ipv4:127.0.0.1:4321, id 0123)"
std::string text_of(const rpc::CallRecord& call) {
  std::string what;
  if (!call.asset.empty()) what += call.asset + ", ";
  if (call.upload_bytes > 0) what += fmt::format("{} bytes sent, ", call.upload_bytes);
  if (call.from_store) what += "from the store, ";
  return fmt::format("{} {} in {:.3f} s ({}{}, request {}){}{}", call.method, call.code, call.seconds, what,
                     call.peer, call.request_id, call.message.empty() ? "" : ": ", call.message);
}

void log_call(const rpc::CallRecord& call) {
  log_object(call.code == "INTERNAL" ? spdlog::level::err : spdlog::level::info, text_of(call),
             members_of(call));
}

}  // namespace

RunningService::RunningService(const ServeRequest& request, cli::LazyDevice& device)
    : uploads_(request.upload_folder, request.upload_space),
      admission_(request.queue),
      metrics_([this] { return levels(); }) {
  if (request.store)
    store_ = std::make_shared<service::ContentStore>(
        *request.store, request.store_bytes, [](const std::string& message) { cli::log_error(message); });
  if (request.root) root_.emplace(*request.root);
  if (request.token_file) try {
      tokens_.emplace(*request.token_file);
    } catch (const InputError& error) {
      throw UsageError(fmt::format("--token-file: {}", error.what()));
    }
  start_executor(request.jobs, device);
  backend_.emplace(rpc::Backend{.executor = *executor_,
                                .admission = admission_,
                                .uploads = uploads_,
                                .metrics = metrics_,
                                .store = store_,
                                .root = root_ ? &*root_ : nullptr,
                                .tokens = tokens_ ? &*tokens_ : nullptr,
                                .devices = gpu::list_devices(),
                                .limits = request.limits,
                                .log = log_call,
                                .log_error = [](const std::string& message) { cli::log_error(message); }});
  executor_->device();  // nobody is told that the service is there before it can work
  rpc::forward_grpc_log([](const std::string& message) { cli::log_detail("gRPC: " + message); });
  if (request.metrics_address) {
    scrapes_.emplace(metrics_);
    const int port = metrics_.listen(*request.metrics_address);
    const std::string& address = *request.metrics_address;
    cli::log_note(
        fmt::format("metrics at http://{}:{}/metrics", address.substr(0, address.rfind(':')), port));
  }
  server_.emplace(request.server, *backend_);
}

void RunningService::start_executor(unsigned jobs, cli::LazyDevice& device) try {
  executor_.emplace(
      service::ExecutorOptions{.import_workers = jobs},
      [this, &device]() -> gpu::Device& {
        if (device_asked_) device.forget();  // it was lost
        device_asked_ = true;
        return device.get();
      },
      metrics_, [](const std::string& message) { cli::log_error(message); });
} catch (const std::system_error& error) {
  throw UsageError(fmt::format("--jobs {}: the system does not start as many threads ({}); ask for fewer",
                               jobs, error.code().message()));
}

std::string RunningService::device_name() {
  return executor_->device().name;
}

service::Levels RunningService::levels() const {
  service::Levels levels;
  const service::WorkQueue::Depth depth = executor_->depth();
  levels.waiting = depth.waiting;
  levels.ready = depth.ready;
  levels.admitted = admission_.admitted();
  levels.upload_bytes = uploads_.used_bytes();
  if (store_) {
    levels.stored_analyses = store_->size();
    levels.stored_bytes = store_->bytes();
  }
  return levels;
}

void RunningService::reload_tokens() {
  if (!tokens_) return cli::log_note("SIGHUP: there is no --token-file to read again");
  try {
    tokens_->reload();
    cli::log_note("the tokens were read again");
  } catch (const InputError& error) {
    cli::log_error(fmt::format("{}; the tokens stay as they were", error.what()));
  }
}

void RunningService::begin_to_drain() {
  server_->set_serving(false);
  admission_.close();
}

bool RunningService::wait_for_answers(std::chrono::milliseconds time) {
  return admission_.wait_until_empty(std::chrono::steady_clock::now() + time);
}

// Answers are given to gRPC before they are on the network. Calls that have no end, such as those that watch
// the service's health, are cut off after that second.
void RunningService::hang_up() {
  server_->shut_down(std::chrono::system_clock::now() + std::chrono::seconds(1));
}

}  // namespace scene_analyzer::serve
