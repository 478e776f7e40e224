// logic_error.h — What a call says that the program must not make.
#pragma once

#include <stdexcept>
#include <string>

namespace scene_analyzer {

template <typename Call>
std::string logic_error_of(Call call) {
  try {
    call();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "no std::logic_error";
}

}  // namespace scene_analyzer
