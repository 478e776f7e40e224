// gap_text.h — How near the start triangle of a signal is to the best one, in words.
#pragma once

#include <string>

namespace scene_analyzer::report {

// A relative gap > 0 as "1.4 %", rounded up so that it stays a bound.
std::string gap_percent(double gap);

}  // namespace scene_analyzer::report
