#include "cooccurrence/class_limit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>

namespace scene_analyzer::cooccurrence {
namespace {

constexpr int kSignificantBits = 20;
constexpr std::uint32_t kFewValues =
    16;  // up to here adding values up is faster than looking into prefix sums

// An unevaluated sum high + low with about 106 significant bits: sums of ten million values that differ by
// 1e-7 of themselves lose their differences in a single double.
struct DoubleDouble {
  double high = 0, low = 0;
};

DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

DoubleDouble add(DoubleDouble a, DoubleDouble b) {
  DoubleDouble sum = two_sum(a.high, b.high);
  sum.low += a.low + b.low;
  return two_sum(sum.high, sum.low);
}

DoubleDouble negated(DoubleDouble a) {
  return {-a.high, -a.low};
}

DoubleDouble times(DoubleDouble a, double b) {
  const double product = a.high * b;
  return two_sum(product, std::fma(a.high, b, -product) + a.low * b);
}

DoubleDouble divided(DoubleDouble a, double b) {
  const double quotient = a.high / b;
  const double rest = std::fma(-quotient, b, a.high) + a.low;
  return two_sum(quotient, rest / b);
}

double rounded(double cost) {
  int exponent = 0;
  const double mantissa = std::frexp(cost, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(mantissa, kSignificantBits)), exponent - kSignificantBits);
}

class UnionCost {
 public:
  explicit UnionCost(std::span<const double> values) : values_(values), prefix_(values.size() + 1) {
    for (std::size_t i = 0; i < values.size(); ++i) prefix_[i + 1] = add(prefix_[i], {values[i], 0});
  }

  DoubleDouble sum(std::uint32_t first, std::uint32_t end) const {
    return add(prefix_[end], negated(prefix_[first]));
  }

  // Rounded sum |value - mean| over [first, end). Values above and below the mean deviate by the same sum in
  // total.
  double operator()(std::uint32_t first, std::uint32_t end) const {
    return rounded(end - first <= kFewValues ? of_few(first, end) : of_many(first, end));
  }

 private:
  // Offsets from the smallest value are exact for values within a factor of two of each other.
  double of_few(std::uint32_t first, std::uint32_t end) const {
    const double base = values_[first];
    double mean = 0;
    for (std::uint32_t i = first; i < end; ++i) mean += values_[i] - base;
    mean /= end - first;
    double cost = 0;
    for (std::uint32_t i = first; i < end; ++i) cost += std::abs((values_[i] - base) - mean);
    return cost;
  }

  double of_many(std::uint32_t first, std::uint32_t end) const {
    const DoubleDouble mean = divided(sum(first, end), end - first);
    const auto above = static_cast<std::uint32_t>(
        std::upper_bound(values_.begin() + first, values_.begin() + end, mean.high) - values_.begin());
    return 2 * add(sum(above, end), negated(times(mean, end - above))).high;
  }

  std::span<const double> values_;
  std::vector<DoubleDouble> prefix_;
};

// A pair of neighbouring groups [first, ...) and [..., end) as it was when it entered the heap.
struct Pair {
  double cost;
  std::uint32_t first, end;
  bool operator>(const Pair& other) const {
    return std::tie(cost, first) > std::tie(other.cost, other.first);
  }
};

// Groups as ranges of values: end_of[first] for each group's first value, before[first] the first value of
// the group before.
class Groups {
 public:
  explicit Groups(std::uint32_t count) : end_of_(count), before_(count), alive_(count, true) {
    for (std::uint32_t i = 0; i < count; ++i) {
      end_of_[i] = i + 1;
      before_[i] = i == 0 ? 0 : i - 1;
    }
  }
  std::uint32_t end(std::uint32_t first) const { return end_of_[first]; }
  std::uint32_t before(std::uint32_t first) const { return before_[first]; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(end_of_.size()); }
  bool is_current(const Pair& pair) const {
    return alive_[pair.first] && end_of_[pair.first] < count() && end_of_[end_of_[pair.first]] == pair.end;
  }
  void join(const Pair& pair) {
    alive_[end_of_[pair.first]] = false;
    end_of_[pair.first] = pair.end;
    if (pair.end < count()) before_[pair.end] = pair.first;
  }

 private:
  std::vector<std::uint32_t> end_of_, before_;
  std::vector<bool> alive_;
};

}  // namespace

std::vector<double> limit_classes(std::span<const double> values, std::uint64_t limit) {
  std::vector<double> limited(values.begin(), values.end());
  if (values.size() <= limit) return limited;
  const UnionCost cost(values);
  Groups groups(static_cast<std::uint32_t>(values.size()));
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i + 1 < groups.count(); ++i) pairs.push_back({cost(i, i + 2), i, i + 2});
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> heap(std::greater<>{}, std::move(pairs));
  for (std::uint64_t left = values.size(); left > limit;) {
    const Pair pair = heap.top();
    heap.pop();
    if (!groups.is_current(pair)) continue;
    groups.join(pair);
    --left;
    if (pair.end < groups.count())
      heap.push({cost(pair.first, groups.end(pair.end)), pair.first, groups.end(pair.end)});
    if (pair.first > 0) {
      const std::uint32_t before = groups.before(pair.first);
      heap.push({cost(before, pair.end), before, pair.end});
    }
  }
  for (std::uint32_t first = 0; first < groups.count(); first = groups.end(first)) {
    const std::uint32_t end = groups.end(first);
    if (end - first > 1)
      std::fill(limited.begin() + first, limited.begin() + end,
                divided(cost.sum(first, end), end - first).high);
  }
  return limited;
}

}  // namespace scene_analyzer::cooccurrence
