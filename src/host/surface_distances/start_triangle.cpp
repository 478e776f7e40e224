#include "surface_distances/start_triangle.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "surface_distances/candidates.h"
#include "surface_distances/patch_bounds.h"
#include "surface_distances/shortest_paths.h"

namespace scene_analyzer::surface_distances {
namespace {

// Sizes of what is done side by side, fixed so that the number of threads changes nothing.
constexpr std::size_t kSourcesPerRound = 4;
constexpr std::size_t kPatchesPerRound = 8;
// Sources that alternate with the triangle farthest from all before: they see the whole shape, and are the
// landmarks.
constexpr std::size_t kScouts = 16;
// Edges with at least so many triangles, and at most so many edges, are searched from, too.
constexpr std::uint32_t kLeastOnHub = 16;
constexpr std::size_t kMostHubs = 8;
// A search that closes a smaller part of the triangles is no longer worth its time...
constexpr double kWorthwhile = 0.002;
// ... unless so few are left that patches would take longer.
constexpr std::size_t kFew = 64;
// Patches: larger ones share more, but across wide ones shortest paths have too little in common.
constexpr std::size_t kPatchSize = 4096;
constexpr std::size_t kLeastPatch = 128;
constexpr double kPatchReach = 0.15;  // of the component's extent
constexpr double kLevel =
    1e-11;  // totals closer than this to the best cannot raise it by anything that counts

class StartSearch {
 public:
  StartSearch(const DualGraph& graph, std::span<const double> areas, std::span<const std::uint32_t> indices,
              const StartSearchOptions& options)
      : graph_(graph), areas_(areas), indices_(indices), options_(options), candidates_(graph.triangles) {
    const unsigned threads = std::clamp<unsigned>(options.threads, 1, kPatchesPerRound);
    for (unsigned i = 0; i < threads; ++i) paths_.push_back(std::make_unique<ShortestPaths>(graph));
    bounders_.resize(threads);
  }

  StartTriangle run() {
    scout();
    search_best_first();
    bound_patches();
    search_remaining();
    settle_ties();
    return result();
  }

 private:
  bool spent() const { return work_ >= options_.most_searches * graph_.nodes(); }

  template <typename Task>
  void side_by_side(std::size_t count, Task task) {
    run_side_by_side(count, paths_.size(), options_.stop, task);
  }

  void search(const std::vector<std::uint32_t>& sources) {
    if (distances_.size() < sources.size()) distances_.resize(sources.size());
    std::vector<double> totals(sources.size());
    side_by_side(sources.size(), [&](std::size_t i, std::size_t worker) {
      distances_[i].resize(graph_.nodes());
      paths_[worker]->run(sources[i], distances_[i]);
      totals[i] = total_distance(graph_, distances_[i]);
    });
    for (std::size_t i = 0; i < sources.size(); ++i) {
      if (sources[i] < graph_.triangles) candidates_.set_total(sources[i], totals[i]);
      candidates_.bound_all(totals[i], distances_[i]);
    }
    work_ += sources.size() * graph_.nodes();
  }

  // First the far ends of the shape.
  void scout() {
    distances_.assign(1, std::vector<double>(graph_.nodes()));
    paths_[0]->run(0, distances_[0]);
    work_ += graph_.nodes();
    const auto triangles = std::span(distances_[0]).first(graph_.triangles);
    extent_ = *std::ranges::max_element(triangles);
    search({static_cast<std::uint32_t>(std::ranges::max_element(triangles) - triangles.begin())});
    search(hubs());
  }

  // Edges with the most triangles, many of which may hang on nothing else.
  std::vector<std::uint32_t> hubs() const {
    const auto triangles_on = [&](std::uint32_t node) { return graph_.first[node + 1] - graph_.first[node]; };
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t node = graph_.triangles; node < graph_.nodes(); ++node)
      if (triangles_on(node) >= kLeastOnHub) nodes.push_back(node);
    const std::size_t taken = std::min(nodes.size(), kMostHubs);
    std::ranges::partial_sort(
        nodes, nodes.begin() + static_cast<std::ptrdiff_t>(taken), {},
        [&](std::uint32_t node) { return std::pair(-std::int64_t{triangles_on(node)}, node); });
    nodes.resize(taken);
    return nodes;
  }

  void search_best_first() {
    std::vector<std::uint32_t> open = candidates_.open();
    for (std::size_t searches = 1; !open.empty() && !spent();) {
      const std::vector<std::uint32_t> sources = next_sources(open, searches < kScouts);
      search(sources);
      searches += sources.size();
      const std::size_t before = open.size();
      open = candidates_.open();
      report(open.size());
      const double worthwhile = kWorthwhile * static_cast<double>(sources.size()) * graph_.triangles;
      if (searches > kScouts && open.size() > kFew && static_cast<double>(before - open.size()) < worthwhile)
        return;
    }
  }

  // The open triangle of the largest bound; further ones after lowering bounds by what the first are expected
  // to prove.
  std::vector<std::uint32_t> next_sources(const std::vector<std::uint32_t>& open, bool scouting) const {
    const auto n = static_cast<double>(graph_.triangles);
    std::vector<double> expected;
    for (const std::uint32_t v : open) expected.push_back(candidates_.upper(v));
    std::vector<std::uint32_t> sources;
    while (sources.size() < std::min(kSourcesPerRound, open.size())) {
      const auto highest = static_cast<std::size_t>(std::ranges::max_element(expected) - expected.begin());
      if (expected[highest] < candidates_.threshold()) break;
      const std::uint32_t source = open[highest];
      sources.push_back(source);
      for (std::size_t i = 0; i < open.size(); ++i)
        expected[i] =
            std::min(expected[i], candidates_.best() + n * candidates_.about_distance(open[i], source));
      expected[highest] = 0;
    }
    if (!scouting) return sources;
    const std::uint32_t far = candidates_.farthest();
    if (!candidates_.is_searched(far) && std::ranges::find(sources, far) == sources.end())
      sources.back() = far;
    return sources;
  }

  void bound_patches() {
    std::vector<std::uint32_t> unbounded = candidates_.open();
    const std::size_t all = unbounded.size();
    while (unbounded.size() > kFew && !spent()) {
      const auto patches = take_patches(unbounded, patch_size());
      bound(patches);
      std::erase_if(unbounded, [&](std::uint32_t v) { return !candidates_.is_open(v); });
      if (options_.progress)
        options_.progress(1 - static_cast<double>(unbounded.size()) / static_cast<double>(all));
    }
  }
  std::size_t patch_size() const { return kPatchSize; }

  void bound(const std::vector<std::vector<std::uint32_t>>& patches) {
    std::vector<PatchResult> results(patches.size());
    side_by_side(patches.size(), [&](std::size_t i, std::size_t worker) {
      if (!bounders_[worker]) bounders_[worker] = std::make_unique<PatchBounder>(graph_);
      results[i] = bounders_[worker]->bound(patches[i], candidates_);
    });
    for (const PatchResult& result : results) {
      work_ += result.work;
      for (const auto& [v, total] : result.totals) candidates_.set_total(v, total);
      for (const auto& [v, upper] : result.bounds) candidates_.lower_upper(v, upper);
    }
  }

  // Takes patches around those of the largest bounds out of `open`.
  std::vector<std::vector<std::uint32_t>> take_patches(std::vector<std::uint32_t>& open,
                                                       std::size_t size) const {
    std::vector<std::vector<std::uint32_t>> patches;
    while (patches.size() < kPatchesPerRound && !open.empty()) {
      const std::uint32_t centre =
          *std::ranges::max_element(open, {}, [&](std::uint32_t v) { return candidates_.upper(v); });
      std::vector<std::pair<float, std::uint32_t>> near;
      for (const std::uint32_t v : open)
        near.emplace_back(v == centre ? -1 : candidates_.about_distance(v, centre), v);
      const std::size_t taken = keep_nearest(near, size);
      auto& patch = patches.emplace_back();
      open.clear();
      for (std::size_t i = 0; i < near.size(); ++i) (i < taken ? patch : open).push_back(near[i].second);
    }
    return patches;
  }

  // Sorts the front of `near`: what makes a patch. Returns how many that are.
  std::size_t keep_nearest(std::vector<std::pair<float, std::uint32_t>>& near, std::size_t size) const {
    const std::size_t most = std::min(size, near.size());
    std::ranges::nth_element(near, near.begin() + static_cast<std::ptrdiff_t>(most) - 1);
    std::ranges::sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(most));
    std::size_t taken = std::min(kLeastPatch, most);
    while (taken < most && near[taken].first <= kPatchReach * extent_) ++taken;
    return taken;
  }

  // True totals for all that may be larger than the best.
  void search_remaining() {
    while (!spent()) {
      std::vector<std::uint32_t> above = candidates_.open();
      std::erase_if(
          above, [&](std::uint32_t v) { return candidates_.upper(v) <= candidates_.best() * (1 + kLevel); });
      if (above.empty()) return;
      bound(take_patches(above, kLanes));
    }
  }

  // Smaller area, then lower index.
  std::vector<std::uint32_t> by_preference(std::vector<std::uint32_t> nodes) const {
    std::ranges::sort(nodes, {}, [&](std::uint32_t v) { return std::pair(areas_[v], indices_[v]); });
    std::size_t equal_end = 0;
    while (equal_end < nodes.size() && areas_[nodes[equal_end]] <= areas_[nodes[0]] * (1 + kTie)) ++equal_end;
    std::ranges::sort(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(equal_end), {},
                      [&](std::uint32_t v) { return indices_[v]; });
    return nodes;
  }

  // Searches open triangles as long as they would be preferred to the preferred winner.
  void settle_ties() {
    while (!spent()) {
      std::vector<std::uint32_t> tied = candidates_.winners();
      for (const std::uint32_t v : candidates_.open()) tied.push_back(v);
      tied = by_preference(std::move(tied));
      std::vector<std::uint32_t> unknown;
      for (const std::uint32_t v : tied) {
        if (candidates_.is_searched(v)) break;
        if (unknown.size() < kSourcesPerRound) unknown.push_back(v);
      }
      if (unknown.empty()) return;
      search(unknown);
    }
  }

  StartTriangle result() const {
    const std::uint32_t node = by_preference(candidates_.winners()).front();
    double highest = 0;
    for (const std::uint32_t v : candidates_.open()) highest = std::max(highest, candidates_.upper(v));
    const double best = candidates_.best();
    const bool proven = highest <= best * (1 + kLevel);
    return {.node = node,
            .total_distance = candidates_.upper(node),
            .gap = proven || best == 0 ? 0 : highest / best - 1,
            .searches = (work_ + graph_.nodes() - 1) / graph_.nodes()};
  }

  void report(std::size_t open) const {
    if (options_.progress) options_.progress(0.5 * (1 - static_cast<double>(open) / graph_.triangles));
  }

  const DualGraph& graph_;
  std::span<const double> areas_;
  std::span<const std::uint32_t> indices_;
  const StartSearchOptions& options_;
  Candidates candidates_;
  std::vector<std::unique_ptr<ShortestPaths>> paths_;    // per thread
  std::vector<std::unique_ptr<PatchBounder>> bounders_;  // per thread, made when needed
  std::vector<std::vector<double>> distances_;           // per source of a round
  double extent_ = 0;       // how far the farthest triangle is from some triangle
  std::uint64_t work_ = 0;  // sources x rows
};

}  // namespace

StartTriangle find_start_triangle(const DualGraph& graph, std::span<const double> areas,
                                  std::span<const std::uint32_t> indices, const StartSearchOptions& options) {
  if (graph.triangles == 1) return {};
  return StartSearch(graph, areas, indices, options).run();
}

}  // namespace scene_analyzer::surface_distances
