#include "rpc/call.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "gpu/error.h"
#include "import/text.h"

namespace scene_analyzer::rpc {
namespace {

using service::Reason;
using service::Refusal;
using Clock = std::chrono::steady_clock;

constexpr const char* kRequestId = "x-request-id";
constexpr std::size_t kLongestRequestId = 128;

// Of the first value of that key; empty without one.
std::string_view metadata(const grpc::ServerContext& context, const char* key) {
  const auto found = context.client_metadata().find(key);
  if (found == context.client_metadata().end()) return {};
  return {found->second.data(), found->second.size()};
}

// What stands in logs must not be able to break their lines.
bool is_request_id(std::string_view text) {
  const auto allowed = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' ||
           c == '_' || c == '-';
  };
  return !text.empty() && text.size() <= kLongestRequestId && std::ranges::all_of(text, allowed);
}

std::string make_request_id() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::system_error(errno, std::generic_category(), "making a request id");
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

grpc::StatusCode code_of(Reason reason) {
  switch (reason) {
    case Reason::kInvalid:
      return grpc::StatusCode::INVALID_ARGUMENT;
    case Reason::kNotFound:
      return grpc::StatusCode::NOT_FOUND;
    case Reason::kUnauthenticated:
      return grpc::StatusCode::UNAUTHENTICATED;
    case Reason::kTooLarge:
    case Reason::kBusy:
      return grpc::StatusCode::RESOURCE_EXHAUSTED;
    case Reason::kUnavailable:
      return grpc::StatusCode::UNAVAILABLE;
    case Reason::kCancelled:
      return grpc::StatusCode::CANCELLED;
    case Reason::kInternal:
      return grpc::StatusCode::INTERNAL;
  }
  return grpc::StatusCode::INTERNAL;
}

const char* name_of(grpc::StatusCode code) {
  switch (code) {
    case grpc::StatusCode::OK:
      return "OK";
    case grpc::StatusCode::INVALID_ARGUMENT:
      return "INVALID_ARGUMENT";
    case grpc::StatusCode::NOT_FOUND:
      return "NOT_FOUND";
    case grpc::StatusCode::UNAUTHENTICATED:
      return "UNAUTHENTICATED";
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return "RESOURCE_EXHAUSTED";
    case grpc::StatusCode::UNAVAILABLE:
      return "UNAVAILABLE";
    case grpc::StatusCode::CANCELLED:
      return "CANCELLED";
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return "DEADLINE_EXCEEDED";
    default:
      return "INTERNAL";
  }
}

// A status message travels as one header, in which every byte beyond ASCII takes three; clients take 8 KiB of
// headers.
constexpr std::size_t kLongestMessage = 2000;

}  // namespace

void check_size(std::size_t message_bytes) {
  if (message_bytes > kMostMessageBytes)
    throw Refusal(
        Reason::kTooLarge,
        fmt::format("a message has {} bytes, more than {}; send files in pieces of at most 4 MiB, and "
                    "content keys in place of analyses",
                    message_bytes, kMostMessageBytes));
}

Call::Call(Backend& backend, const char* method, grpc::ServerContext& context)
    : backend_(backend), context_(context) {
  record_.method = method;
  record_.peer = context.peer();
  const std::string_view id = metadata(context, kRequestId);
  record_.request_id = is_request_id(id) ? std::string(id) : make_request_id();
  context_.AddTrailingMetadata(kRequestId, record_.request_id);
}

grpc::Status Call::run(const std::function<void()>& work) {
  const Clock::time_point begin = Clock::now();
  const grpc::Status status = attempt(work);
  record_.code = name_of(status.error_code());
  record_.message = status.error_message();
  record_.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  backend_.metrics.count_request(record_.method.c_str(), record_.code.c_str(), record_.seconds);
  backend_.metrics.add_upload_bytes(record_.upload_bytes);
  backend_.log(record_);
  return status;
}

grpc::Status Call::attempt(const std::function<void()>& work) {
  try {
    check_token();
    work();
    return grpc::Status::OK;
  } catch (const Refusal& refusal) {
    return refuse(refusal);
  } catch (const gpu::Error& error) {
    backend_.log_error(fmt::format("request {}: {}", record_.request_id, error.what()));
    return refuse({Reason::kUnavailable, "the service has no device at the moment"});
  } catch (const std::bad_alloc&) {
    return refuse({Reason::kTooLarge, "the service's machine has too little free memory for it"});
  } catch (const std::exception& error) {
    backend_.log_error(fmt::format("request {}: {}", record_.request_id, error.what()));
    return refuse({Reason::kInternal, "a defect of the service; its log says more under this request's id"});
  }
}

grpc::Status Call::refuse(const Refusal& refusal) {
  backend_.metrics.count_failure(refusal.reason());
  // What clients that try again by themselves look at; a negative time tells them not to.
  if (refusal.retry_after())
    context_.AddTrailingMetadata("grpc-retry-pushback-ms", std::to_string(refusal.retry_after()->count()));
  else if (refusal.reason() == Reason::kTooLarge)
    context_.AddTrailingMetadata("grpc-retry-pushback-ms", "-1");
  const bool is_late =
      refusal.reason() == Reason::kCancelled && context_.deadline() <= std::chrono::system_clock::now();
  return {is_late ? grpc::StatusCode::DEADLINE_EXCEEDED : code_of(refusal.reason()),
          import::clean_text(refusal.what(), kLongestMessage)};
}

void Call::check_token() const {
  if (backend_.tokens == nullptr || backend_.tokens->accepts(metadata(context_, "authorization"))) return;
  throw Refusal(Reason::kUnauthenticated,
                "the token is missing or unknown; send the metadata 'authorization: Bearer TOKEN'");
}

void Call::check_cancelled() const {
  if (context_.IsCancelled()) throw Refusal(Reason::kCancelled, "the client no longer waits");
}

}  // namespace scene_analyzer::rpc
