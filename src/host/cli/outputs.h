// outputs.h — What a command prints and writes when its work is done.
#pragma once

#include <functional>

namespace scene_analyzer::cli {

// Each output is tried: a full disk for one of them is no reason to lose the others.
class Outputs {
 public:
  // An InputError of `write` is logged; everything else is thrown on.
  void attempt(const std::function<void()>& write);
  bool are_good() const { return good_; }  // all so far

 private:
  bool good_ = true;
};

}  // namespace scene_analyzer::cli
