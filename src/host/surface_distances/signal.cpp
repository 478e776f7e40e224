#include "surface_distances/signal.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <tuple>

#include "surface_distances/shortest_paths.h"
#include "surface_distances/start_triangle.h"

namespace scene_analyzer::surface_distances {
namespace {

// Components up to this many triangles are searched by one thread each.
constexpr std::uint32_t kSmall = 20000;
// Values closer than this, relative to the largest, count as equal.
constexpr double kEqual = 1e-9;

struct Part {
  std::vector<double> areas;  // in the order of the signal
  double total_area = 0;
  StartTriangle start;
  std::uint32_t start_triangle = 0;
};

// In units of the tolerance: equal numbers are equal values.
double rounded(double value, double largest) {
  return largest > 0 ? std::round(value / largest / kEqual) : 0;
}

std::vector<double> areas_by_distance(const Component& component, std::span<const double> areas,
                                      std::span<const double> distances) {
  const double farthest = *std::max_element(distances.begin(), distances.begin() + component.graph.triangles);
  const double largest = *std::ranges::max_element(areas);
  struct Key {
    double distance, area;
    std::uint32_t triangle, node;
    bool operator<(const Key& other) const {
      return std::tie(distance, area, triangle) < std::tie(other.distance, other.area, other.triangle);
    }
  };
  std::vector<Key> keys;
  keys.reserve(areas.size());
  for (std::uint32_t node = 0; node < component.graph.triangles; ++node)
    keys.push_back(
        {rounded(distances[node], farthest), rounded(areas[node], largest), component.triangles[node], node});
  std::ranges::sort(keys, std::less<>());
  std::vector<double> sorted;
  sorted.reserve(keys.size());
  for (const Key& key : keys) sorted.push_back(areas[key.node]);
  return sorted;
}

Part measure(const Component& component, std::span<const double> areas_of_mesh,
             const StartSearchOptions& options) {
  std::vector<double> areas;
  areas.reserve(component.triangles.size());
  for (const std::uint32_t triangle : component.triangles) areas.push_back(areas_of_mesh[triangle]);
  Part part;
  part.start = find_start_triangle(component.graph, areas, component.triangles, options);
  part.start_triangle = component.triangles[part.start.node];
  std::vector<double> distances(component.graph.nodes());
  ShortestPaths(component.graph).run(part.start.node, distances);
  part.areas = areas_by_distance(component, areas, distances);
  // Summed in the order of the signal, so that the order of triangles in the file leaves no trace.
  part.total_area = std::accumulate(part.areas.begin(), part.areas.end(), 0.0);
  return part;
}

// Descending count, then area, then ascending signal; areas and values within kEqual are equal.
void order_parts(std::vector<Part>& parts) {
  std::ranges::sort(parts, [](const Part& a, const Part& b) {
    return a.areas.size() != b.areas.size() ? a.areas.size() > b.areas.size() : a.total_area > b.total_area;
  });
  double largest = 0;
  for (const Part& part : parts)
    for (const double area : part.areas) largest = std::max(largest, area);
  const auto by_signal = [&](const Part& a, const Part& b) {
    return std::ranges::lexicographical_compare(
        a.areas, b.areas, {}, [&](double x) { return rounded(x, largest); },
        [&](double x) { return rounded(x, largest); });
  };
  for (auto begin = parts.begin(); begin != parts.end();) {
    auto end = begin + 1;
    while (end != parts.end() && end->areas.size() == begin->areas.size() &&
           (end - 1)->total_area - end->total_area <= kEqual * (end - 1)->total_area)
      ++end;
    std::stable_sort(begin, end, by_signal);
    begin = end;
  }
}

Signal join(std::vector<Part> parts) {
  Signal signal;
  if (parts.empty()) return signal;
  order_parts(parts);
  const Part& first = parts.front();
  signal.start_triangle = first.start_triangle;
  signal.mean_distance = first.start.total_distance / static_cast<double>(first.areas.size() - 1);
  for (const Part& part : parts) {
    signal.areas.insert(signal.areas.end(), part.areas.begin(), part.areas.end());
    signal.gap = std::max(signal.gap, part.start.gap);
    signal.searches = std::max(signal.searches, part.start.searches);
  }
  return signal;
}

// All components of all surfaces, as tasks.
class Measuring {
 public:
  Measuring(std::span<const MeshSurface> surfaces, const SignalOptions& options)
      : surfaces_(surfaces), options_(options) {
    for (const MeshSurface& surface : surfaces) {
      components_.push_back(connected_components(surface));
      parts_.emplace_back(components_.back().size());
      const auto mesh = static_cast<std::uint32_t>(parts_.size() - 1);
      for (std::uint32_t i = 0; i < components_.back().size(); ++i) {
        const std::uint32_t triangles = components_.back()[i].graph.triangles;
        (triangles <= kSmall ? small_ : large_).push_back({mesh, i});
        triangles_ += triangles;
      }
    }
  }

  std::vector<Signal> run() {
    run_small();
    for (const Task& task : large_) measure_task(task, options_.threads);
    std::vector<Signal> signals;
    for (auto& parts : parts_) signals.push_back(join(std::move(parts)));
    return signals;
  }

 private:
  struct Task {
    std::uint32_t mesh, component;
  };

  void run_small() {
    // The largest first, so that no thread is left with one at the end.
    std::ranges::stable_sort(small_, std::greater<>(),
                             [&](const Task& task) { return component(task).graph.triangles; });
    // Threads cost more than the smallest searches.
    const std::size_t workers = std::min<std::size_t>(options_.threads, small_.size() / 8 + 1);
    run_side_by_side(small_.size(), workers, options_.stop,
                     [&](std::size_t i, std::size_t) { measure_task(small_[i], 1); });
  }

  Component& component(const Task& task) { return components_[task.mesh][task.component]; }

  void measure_task(const Task& task, unsigned threads) {
    Component& component = this->component(task);
    const std::uint32_t triangles = component.graph.triangles;
    StartSearchOptions options{
        .most_searches = options_.most_searches, .threads = threads, .stop = options_.stop, .progress = {}};
    if (triangles > kSmall) options.progress = [&](double fraction) { report(fraction * triangles); };
    parts_[task.mesh][task.component] = measure(component, surfaces_[task.mesh].areas, options);
    component = {};  // its memory is wanted by the next
    const std::scoped_lock lock(mutex_);
    done_ += triangles;
    if (options_.progress) options_.progress(static_cast<double>(done_) / static_cast<double>(triangles_));
  }

  void report(double within) {
    const std::scoped_lock lock(mutex_);
    if (options_.progress)
      options_.progress((static_cast<double>(done_) + within) / static_cast<double>(triangles_));
  }

  std::span<const MeshSurface> surfaces_;
  const SignalOptions& options_;
  std::vector<std::vector<Component>> components_;  // per surface
  std::vector<std::vector<Part>> parts_;
  std::vector<Task> small_, large_;
  std::mutex mutex_;
  std::uint64_t triangles_ = 0, done_ = 0;
};

}  // namespace

std::vector<Signal> measure_signals(std::span<const MeshSurface> surfaces, const SignalOptions& options) {
  return Measuring(surfaces, options).run();
}

}  // namespace scene_analyzer::surface_distances
