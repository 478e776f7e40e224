// refused.h — What the service room refuses, as one text: "invalid: a file has no name", "" for nothing.
#pragma once

#include <string>

#include "service/refusal.h"

namespace scene_analyzer::service {

template <typename Body>
std::string refused(Body body) {
  try {
    body();
  } catch (const Refusal& refusal) {
    return std::string(to_string(refusal.reason())) + ": " + refusal.what();
  }
  return "";
}

}  // namespace scene_analyzer::service
