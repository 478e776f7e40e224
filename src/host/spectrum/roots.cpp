#include "spectrum/roots.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace scene_analyzer::spectrum {

Complex root_of_unity(std::uint64_t j, std::uint64_t n) {
  std::uint64_t eighths = 8 * (j % n);  // of the angle 2 pi / 8 n
  const bool below = eighths > 4 * n;
  if (below) eighths = 8 * n - eighths;
  const bool left = eighths > 2 * n;
  if (left) eighths = 4 * n - eighths;
  const bool steep = eighths > n;
  if (steep) eighths = 2 * n - eighths;
  const double angle = std::numbers::pi / 4 * static_cast<double>(eighths) / static_cast<double>(n);
  double cosine = std::cos(angle), sine = std::sin(angle);
  if (steep) std::swap(cosine, sine);
  return {left ? -cosine : cosine, below ? sine : -sine};
}

void append_roots(std::vector<Complex>& table, std::uint32_t n) {
  for (std::uint32_t j = 0; j < n; ++j) table.push_back(root_of_unity(j, n));
}

void append_split_roots(std::vector<Complex>& table, std::uint32_t n, std::uint32_t fine_bits) {
  const std::uint64_t step = std::uint64_t{1} << fine_bits;
  for (std::uint64_t j = 0; j < step; ++j) table.push_back(root_of_unity(j, n));
  for (std::uint64_t j = 0; j < n; j += step) table.push_back(root_of_unity(j, n));
}

}  // namespace scene_analyzer::spectrum
