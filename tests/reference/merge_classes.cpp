#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include "reference/area_classes.h"

namespace scene_analyzer::reference {
namespace {

// Neighbouring values differ by as little as 1e-7 of themselves and ten million of them are summed. With 113
// bits even the difference of two such sums is right to far more than the 20 bits that count.
__extension__ using Quad = __float128;

constexpr int kSignificantBits = 20;
constexpr std::uint32_t kFewValues = 48;  // up to here adding them up is faster than four quad operations

double rounded_cost(long double cost) {
  int exponent = 0;
  const long double mantissa = std::frexp(cost, &exponent);
  return static_cast<double>(
      std::ldexp(std::nearbyint(std::ldexp(mantissa, kSignificantBits)), exponent - kSignificantBits));
}

class UnionCost {
 public:
  explicit UnionCost(std::span<const double> values) : values_(values), prefix_(values.size() + 1) {
    for (std::size_t i = 0; i < values.size(); ++i) prefix_[i + 1] = prefix_[i] + Quad(values[i]);
  }

  // sum |value - mean| over [left, right), rounded.
  double operator()(std::uint32_t left, std::uint32_t right) const {
    return rounded_cost(right - left <= kFewValues ? by_adding(left, right) : by_prefix_sums(left, right));
  }

 private:
  // Distances from the first value instead of values: nothing is left that could cancel.
  long double by_adding(std::uint32_t left, std::uint32_t right) const {
    const long double base = values_[left];
    long double mean = 0;
    for (std::uint32_t v = left; v < right; ++v) mean += values_[v] - base;
    mean /= right - left;
    long double cost = 0;
    for (std::uint32_t v = left; v < right; ++v) cost += std::abs((values_[v] - base) - mean);
    return cost;
  }

  // What lies above the mean weighs as much as what lies below, so the cost is twice (mean * count below -
  // sum below). Multiplied by the count, only the last division rounds.
  long double by_prefix_sums(std::uint32_t left, std::uint32_t right) const {
    const Quad count = right - left;
    const Quad sum = prefix_[right] - prefix_[left];
    const std::uint32_t middle = first_above_mean(left, right, sum, count);
    const Quad times_count = 2 * (sum * Quad(middle - left) - count * (prefix_[middle] - prefix_[left]));
    return static_cast<long double>(times_count / count);
  }

  std::uint32_t first_above_mean(std::uint32_t left, std::uint32_t right, Quad sum, Quad count) const {
    const auto begin = values_.begin();
    auto middle = static_cast<std::uint32_t>(
        std::upper_bound(begin + left, begin + right, static_cast<double>(sum / count)) - begin);
    // The search compared with a rounded mean; the values beside it decide exactly.
    while (middle < right && Quad(values_[middle]) * count <= sum) ++middle;
    while (middle > left && Quad(values_[middle - 1]) * count > sum) --middle;
    return middle;
  }

  std::span<const double> values_;
  std::vector<Quad> prefix_;
};

// Joining [left, ...) with its neighbour that ends at `right`.
struct Candidate {
  double cost;
  std::uint32_t left, right;
  bool operator>(const Candidate& other) const {
    return cost != other.cost ? cost > other.cost : left > other.left;
  }
};

}  // namespace

std::vector<std::uint32_t> merge_classes(std::span<const double> values, std::size_t dim) {
  const auto count = static_cast<std::uint32_t>(values.size());
  const UnionCost cost(values);
  // Group [l, end[l]); end is 0 where no group starts. begin[r]: start of the group that ends at r.
  std::vector<std::uint32_t> end(std::size_t{count} + 1), begin(std::size_t{count} + 1);
  std::vector<Candidate> pairs;
  for (std::uint32_t v = 0; v < count; ++v) {
    end[v] = v + 1;
    begin[v + 1] = v;
    if (v + 1 < count && count > dim) pairs.push_back({cost(v, v + 2), v, v + 2});
  }
  std::priority_queue queue(std::greater<Candidate>(), std::move(pairs));
  for (std::size_t groups = count; groups > dim;) {
    const Candidate best = queue.top();
    queue.pop();
    const std::uint32_t middle = end[best.left];
    if (middle == 0 || middle >= count || end[middle] != best.right)
      continue;  // one of the two has changed since
    end[best.left] = best.right;
    end[middle] = 0;
    begin[best.right] = best.left;
    --groups;
    if (best.left > 0) {
      const std::uint32_t before = begin[best.left];
      queue.push({cost(before, best.right), before, best.right});
    }
    if (best.right < count) queue.push({cost(best.left, end[best.right]), best.left, end[best.right]});
  }
  std::vector<std::uint32_t> starts;
  for (std::uint32_t v = 0; v < count; v = end[v]) starts.push_back(v);
  return starts;
}

std::vector<std::uint32_t> merge_classes_naive(std::span<const double> values, std::size_t dim) {
  std::vector<std::uint32_t> starts(values.size());
  for (std::uint32_t v = 0; v < starts.size(); ++v) starts[v] = v;
  const auto cost = [&](std::size_t pair) {
    const std::size_t from = starts[pair];
    const std::size_t to = pair + 2 < starts.size() ? starts[pair + 2] : values.size();
    Quad sum = 0;
    for (std::size_t v = from; v < to; ++v) sum += Quad(values[v]);
    const Quad mean = sum / Quad(to - from);
    Quad deviation = 0;
    for (std::size_t v = from; v < to; ++v)
      deviation += Quad(values[v]) < mean ? mean - Quad(values[v]) : Quad(values[v]) - mean;
    return rounded_cost(static_cast<long double>(deviation));
  };
  while (starts.size() > dim) {
    std::size_t best = 0;
    double least = cost(0);
    for (std::size_t pair = 1; pair + 1 < starts.size(); ++pair)
      if (const double candidate = cost(pair); candidate < least) {
        least = candidate;
        best = pair;
      }
    starts.erase(starts.begin() + static_cast<std::ptrdiff_t>(best) + 1);
  }
  return starts;
}

}  // namespace scene_analyzer::reference
