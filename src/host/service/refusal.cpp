#include "service/refusal.h"

namespace scene_analyzer::service {

const char* to_string(Reason reason) {
  switch (reason) {
    case Reason::kInvalid:
      return "invalid";
    case Reason::kNotFound:
      return "not_found";
    case Reason::kUnauthenticated:
      return "unauthenticated";
    case Reason::kTooLarge:
      return "too_large";
    case Reason::kBusy:
      return "busy";
    case Reason::kUnavailable:
      return "unavailable";
    case Reason::kCancelled:
      return "cancelled";
    case Reason::kInternal:
      return "internal";
  }
  return "internal";
}

}  // namespace scene_analyzer::service
