#include "cooccurrence/class_limit.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <utility>

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

// A cost rounded to 20 significant bits (half to even), as an integer that orders like it: sign, exponent and
// the 19 bits of the mantissa behind its leading one. `cost` is not negative.
std::uint32_t rounded(double cost) {
  constexpr int kDropped = 53 - kSignificantBits;
  const auto bits = std::bit_cast<std::uint64_t>(cost);
  const std::uint64_t half = (std::uint64_t{1} << (kDropped - 1)) - 1 + ((bits >> kDropped) & 1);
  return static_cast<std::uint32_t>((bits + half) >> kDropped);
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
  std::uint32_t operator()(std::uint32_t first, std::uint32_t end) const {
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

// A pair of neighbouring groups [first, ...) and [..., end) as it was when it entered the queue.
struct Pair {
  std::uint32_t cost, first, end;
  bool operator>(const Pair& other) const {
    return cost != other.cost ? cost > other.cost : first > other.first;
  }
};

// Hands out pairs by cost, then place. Joining never makes a union cheaper, so costs that are handed out do
// not fall: pairs wait unsorted in buckets of nearly equal costs, and only the bucket being emptied is a
// heap, small enough for the cache.
class PairQueue {
 public:
  explicit PairQueue(const std::vector<Pair>& pairs) {
    const auto cheaper = [](const Pair& a, const Pair& b) { return a.cost < b.cost; };
    base_ = bucket_of(*std::min_element(pairs.begin(), pairs.end(), cheaper));
    for (const Pair& pair : pairs) push(pair);
  }

  void push(const Pair& pair) {
    // Rounding may let a union come out a last bit cheaper than a part of it: then it is next.
    const std::int64_t bucket = std::max(bucket_of(pair) - base_, open_);
    if (bucket == open_) {
      heap_.push_back(pair);
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>{});
      return;
    }
    if (bucket >= static_cast<std::int64_t>(buckets_.size()))
      buckets_.resize(static_cast<std::size_t>(bucket) + 1);
    buckets_[static_cast<std::size_t>(bucket)].push_back(pair);
  }

  // There must be a pair left.
  Pair pop() {
    while (heap_.empty()) {
      heap_ = std::exchange(buckets_[static_cast<std::size_t>(++open_)], {});
      std::make_heap(heap_.begin(), heap_.end(), std::greater<>{});
    }
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>{});
    const Pair pair = heap_.back();
    heap_.pop_back();
    return pair;
  }

 private:
  static constexpr int kBucketBits = 9;  // costs within about 2^-10 of each other share a bucket
  static std::int64_t bucket_of(const Pair& pair) { return pair.cost >> kBucketBits; }

  std::int64_t base_ = 0;
  std::int64_t open_ = -1;
  std::vector<std::vector<Pair>> buckets_;
  std::vector<Pair> heap_;
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
  PairQueue queue(pairs);
  pairs = {};
  for (std::uint64_t left = values.size(); left > limit;) {
    const Pair pair = queue.pop();
    if (!groups.is_current(pair)) continue;
    groups.join(pair);
    --left;
    if (pair.end < groups.count())
      queue.push({cost(pair.first, groups.end(pair.end)), pair.first, groups.end(pair.end)});
    if (pair.first > 0) {
      const std::uint32_t before = groups.before(pair.first);
      queue.push({cost(before, pair.end), before, pair.end});
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
