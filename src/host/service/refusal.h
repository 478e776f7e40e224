// refusal.h — Why a request is not answered, in words for the client and as a kind for programs.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace scene_analyzer::service {

enum class Reason : std::uint8_t {
  kInvalid,  // the request or the asset is wrong: the same again fails again
  kNotFound,
  kUnauthenticated,
  kTooLarge,     // beyond a limit of this service or its machine
  kBusy,         // the same may succeed later
  kUnavailable,  // shutting down, or the device is lost
  kCancelled,    // the client no longer waits
  kInternal,     // a defect
};
inline constexpr std::size_t kReasonCount = 8;
// "invalid", "not_found", ...: in metrics and the log.
const char* to_string(Reason reason);

// What clients are told of what is no concern of theirs; the log says more.
inline constexpr const char* kDefect = "a defect of the service; its log says more";
inline constexpr const char* kShuttingDown = "the service is shutting down";

class Refusal : public std::runtime_error {
 public:
  Refusal(Reason reason, const std::string& what, std::optional<std::chrono::milliseconds> retry_after = {})
      : std::runtime_error(what), reason_(reason), retry_after_(retry_after) {}
  Reason reason() const { return reason_; }
  // When the same may succeed.
  std::optional<std::chrono::milliseconds> retry_after() const { return retry_after_; }

 private:
  Reason reason_;
  std::optional<std::chrono::milliseconds> retry_after_;
};

}  // namespace scene_analyzer::service
