#include "report/gap_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scene_analyzer::report {

std::string gap_percent(double gap) {
  // Finer steps say nothing to anybody, and nobody reads more digits.
  const double percent = std::clamp(100 * gap, 0.01, 1e6);
  // Two digits that count.
  const int last_digit = static_cast<int>(std::floor(std::log10(percent))) - 1;
  const double step = std::pow(10.0, last_digit);
  // A bound that has two digits already is not to be raised by the rounding of its last bit.
  const double steps = std::ceil(percent / step * (1 - 1e-12));
  return fmt::format("{:.{}f} %", steps * step, std::max(0, -last_digit));
}

}  // namespace scene_analyzer::report
