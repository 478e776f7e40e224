// estimate.h — From repeated times of one mesh to one figure that a busy machine does not spoil.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace scene_analyzer::render_timing {

// Nanoseconds per round and rotation; NaN where the clock failed.
class Samples {
 public:
  explicit Samples(std::uint32_t rotations) : rotations_(rotations) {}
  void add(double nanoseconds) { values_.push_back(static_cast<float>(nanoseconds)); }  // a round's, in order
  std::uint32_t rotations() const { return rotations_; }
  std::uint32_t rounds() const {
    return static_cast<std::uint32_t>(values_.size() / rotations_);
  }  // whole ones
  float at(std::uint32_t round, std::uint32_t rotation) const {
    return values_[std::size_t{round} * rotations_ + rotation];
  }

 private:
  std::uint32_t rotations_;
  std::vector<float> values_;
};

struct Estimate {
  double mean = 0;                   // over the rotations, of medians over the rounds
  double fastest = 0, slowest = 0;   // of these medians
  std::optional<double> confidence;  // half of the mean's 95 % interval, from the rounds' means; absent below
                                     // kLeastRounds
};
inline constexpr std::uint32_t kLeastRounds = 5;

// Absent when a rotation has no time at all. Cost: linear in the samples.
std::optional<Estimate> estimate(const Samples& samples);

// Of the values that are numbers; NaN when none is. Reorders them.
double median(std::vector<double>& values);

}  // namespace scene_analyzer::render_timing
