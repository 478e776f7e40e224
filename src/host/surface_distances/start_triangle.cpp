#include "surface_distances/start_triangle.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "surface_distances/candidates.h"
#include "surface_distances/patch_bounds.h"
#include "surface_distances/patches.h"
#include "surface_distances/shortest_paths.h"
#include "surface_distances/sources.h"

namespace scene_analyzer::surface_distances {
namespace {

// Sizes of what is done side by side, fixed so that the number of threads changes nothing.
constexpr std::size_t kSourcesPerRound = 4;
constexpr std::size_t kPatchesPerRound = 8;
// Sources that alternate with the triangle farthest from all before: they see the whole shape. The first 16,
// hubs among them, are the landmarks.
constexpr std::size_t kScouts = 16;
// A search that closes a smaller part of the triangles is no longer worth its time...
constexpr double kWorthwhile = 0.002;
constexpr double kWorthwhileWidely = 0.0004;
// ... unless so few are left that patches would take longer.
constexpr std::size_t kFew = 64;
// Patches: wide ones share more, but across too wide ones shortest paths have too little in common.
constexpr std::size_t kMostInPatch = 65536;
constexpr std::size_t kLeastInPatch = 16;
constexpr std::size_t kLeastOpen = 400;  // for patches; fewer are searched from at once
constexpr double kPatchReach = 0.12;     // of the component's extent, at first
constexpr double kNarrower = 0.75;       // what becomes of the reach when patches were too wide
constexpr double kLeastReach = 0.002;
// Of the way from a patch's totals to the best, the part that smaller graphs may use up: first much, which
// is fast and leaves a few, then little.
struct Pass {
  double slack_share;
  double begin, end;  // as progress
};
constexpr Pass kPasses[] = {{0.15, 0.4, 0.8}, {0.03, 0.8, 0.9}, {0.01, 0.9, 0.95}};
// From the best triangles so far, patches shrink towards still better ones.
constexpr std::size_t kClimbers = 2;
constexpr double kClimbFrom = 0.15;  // of the component's extent
constexpr double kShrink = 0.5;
constexpr double kGroupReach = 0.05;  // of triangles that are searched from together
// Totals closer than this to the best cannot raise it by anything that counts.
constexpr double kLevel = 1e-11;

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
    if (extent_ == 0) return all_in_one_place();
    search_best_first(kScouts);
    climb();
    search_widely();
    search_best_first(0);
    for (const Pass& pass : kPasses) bound_patches(pass);
    search_remaining();
    settle_ties();
    return result();
  }

 private:
  std::uint64_t budget() const { return options_.most_searches * graph_.nodes(); }
  bool spent() const { return work_ >= budget(); }

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
    if (extent_ == 0) return;
    patch_reach_ = kPatchReach * extent_;
    search({static_cast<std::uint32_t>(std::ranges::max_element(triangles) - triangles.begin())});
    search(hubs(graph_));
  }

  // Until a search is no longer worth its time, but not before `scouts` searches, which go to the far ends of
  // the shape, too.
  void search_best_first(std::size_t scouts) {
    std::vector<std::uint32_t> open = candidates_.open();
    for (std::size_t searches = 1; !open.empty() && !spent();) {
      std::vector<std::uint32_t> sources = highest_bounds(open, candidates_, kSourcesPerRound);
      if (searches < scouts) visit_far_end(sources);
      search(sources);
      searches += sources.size();
      const std::size_t before = open.size();
      open = candidates_.open();
      report(0, 0.4, open.size(), graph_.triangles);
      const double worthwhile = kWorthwhile * static_cast<double>(sources.size()) * graph_.triangles;
      if (searches > scouts && open.size() > kFew && static_cast<double>(before - open.size()) < worthwhile)
        return;
    }
  }

  void visit_far_end(std::vector<std::uint32_t>& sources) const {
    const std::uint32_t far = candidates_.farthest();
    if (!candidates_.is_searched(far) && std::ranges::find(sources, far) == sources.end())
      sources.back() = far;
  }

  // From open triangles far from all sources: once the best is good, each closes all around it that is
  // clearly worse.
  void search_widely() {
    std::vector<std::uint32_t> open = candidates_.open();
    std::size_t searches = 0, last_open = open.size();
    while (open.size() > kFew && !spent()) {
      const std::vector<std::uint32_t> sources = far_from_all(open, candidates_, kSourcesPerRound);
      search(sources);
      open = candidates_.open();
      report(0, 0.4, open.size(), graph_.triangles);
      searches += sources.size();
      if (searches < kScouts) continue;
      const double worthwhile = kWorthwhileWidely * static_cast<double>(searches) * graph_.triangles;
      if (static_cast<double>(last_open - open.size()) < worthwhile) return;
      searches = 0;
      last_open = open.size();
    }
  }

  // A good best lets many a bound pass that would fail a poor one.
  void climb() {
    if (candidates_.open().size() <= kFew) return;
    std::vector<std::uint32_t> at = highest_apart(candidates_, kClimbers, kClimbFrom * extent_);
    for (double reach = kClimbFrom * extent_; reach >= kLeastReach * extent_ && !at.empty() && !spent();
         reach *= kShrink) {
      std::vector<Patch> patches;
      for (const std::uint32_t centre : at) patches.push_back(patch_around(centre, candidates_, reach));
      bound(patches,
            [&](PatchBounder& bounder, const Patch& patch) { return bounder.sample(patch, candidates_); });
      at.clear();
      for (const Patch& patch : patches)
        if (patch.size() > kLanes) at.push_back(highest_searched(patch));
    }
  }

  std::uint32_t highest_searched(const Patch& patch) const {
    std::uint32_t highest = patch.front();
    for (const std::uint32_t v : patch)
      if (candidates_.is_searched(v) && candidates_.upper(v) > candidates_.upper(highest)) highest = v;
    return highest;
  }

  void bound_patches(const Pass& pass) {
    std::vector<std::uint32_t> unbounded = candidates_.open();
    const std::size_t all = unbounded.size();
    if (all < kLeastOpen) return;
    while (!unbounded.empty() && !spent()) {
      const std::vector<Patch> patches = take_patches(
          unbounded, candidates_, {.least = kLeastInPatch, .most = patch_most_, .reach = patch_reach_},
          kPatchesPerRound);
      const auto results = bound(patches, [&](PatchBounder& bounder, const Patch& patch) {
        return bounder.bound(patch, candidates_,
                             {.slack_share = pass.slack_share,
                              .most_work = (budget() - work_) / patches.size(),
                              .stop = options_.stop});
      });
      narrow(patches, results, unbounded);
      std::erase_if(unbounded, [&](std::uint32_t v) { return !candidates_.is_open(v); });
      report(pass.begin, pass.end, unbounded.size(), all);
    }
  }

  // Gives back what was too wide, to be taken again in narrower patches. Small ones are never too wide, which
  // ends this even where triangles cannot be told apart by their distances to the landmarks.
  void narrow(const std::vector<Patch>& patches, const std::vector<PatchResult>& results,
              std::vector<std::uint32_t>& unbounded) {
    bool too_wide = false;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      if (!results[i].too_wide) continue;
      too_wide = true;
      unbounded.insert(unbounded.end(), patches[i].begin(), patches[i].end());
    }
    if (too_wide) patch_reach_ *= kNarrower;
    if (patch_reach_ < kLeastReach * extent_) patch_most_ = kLeastInPatch;
  }

  template <typename Bound>
  std::vector<PatchResult> bound(const std::vector<Patch>& patches, Bound bound_patch) {
    std::vector<PatchResult> results(patches.size());
    side_by_side(patches.size(), [&](std::size_t i, std::size_t worker) {
      if (!bounders_[worker]) bounders_[worker] = std::make_unique<PatchBounder>(graph_, unit());
      results[i] = bound_patch(*bounders_[worker], patches[i]);
    });
    for (const PatchResult& result : results) {
      work_ += result.work;
      for (const auto& [v, total] : result.totals) candidates_.set_total(v, total);
      for (const auto& [v, upper] : result.bounds) candidates_.lower_upper(v, upper);
    }
    return results;
  }
  // Twice the room for the farthest pair: no two triangles are farther apart than twice the extent.
  double unit() const { return 4 * extent_ / kUnreached<Units>; }

  // True totals for all that may be larger than the best.
  void search_remaining() {
    std::size_t all = 1;
    while (!spent()) {
      std::vector<std::uint32_t> above = candidates_.open();
      std::erase_if(
          above, [&](std::uint32_t v) { return candidates_.upper(v) <= candidates_.best() * (1 + kLevel); });
      if (above.empty()) return;
      all = std::max(all, above.size());
      report(0.95, 1, above.size(), all);
      bound(take_patches(above, candidates_, {.least = 1, .most = kLanes, .reach = kGroupReach * extent_},
                         kPatchesPerRound),
            [&](PatchBounder& bounder, const Patch& patch) { return bounder.measure(patch); });
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
      ties_settled_ = unknown.empty();
      if (ties_settled_) return;
      search(unknown);
    }
  }

  StartTriangle all_in_one_place() const {
    std::vector<std::uint32_t> all(graph_.triangles);
    std::iota(all.begin(), all.end(), 0U);
    return {.node = by_preference(std::move(all)).front(), .total_distance = 0, .gap = 0, .searches = 1};
  }

  StartTriangle result() const {
    const std::uint32_t node = by_preference(candidates_.winners()).front();
    double highest = 0;
    for (const std::uint32_t v : candidates_.open()) highest = std::max(highest, candidates_.upper(v));
    const double best = candidates_.best();
    const double open_gap = highest <= best * (1 + kLevel) ? 0 : highest / best - 1;
    return {.node = node,
            .total_distance = candidates_.upper(node),
            // Until ties are settled another triangle may be as far out, and be preferred.
            .gap = ties_settled_ ? open_gap : std::max(open_gap, kTie),
            .searches = (work_ + graph_.nodes() - 1) / graph_.nodes()};
  }

  // Progress from `begin` to `end` while `left` of `all` falls; never back.
  void report(double begin, double end, std::size_t left, std::size_t all) {
    const double part = 1 - static_cast<double>(std::min(left, all)) / static_cast<double>(all);
    done_ = std::max(done_, begin + part * (end - begin));
    if (options_.progress) options_.progress(done_);
  }

  const DualGraph& graph_;
  std::span<const double> areas_;
  std::span<const std::uint32_t> indices_;
  const StartSearchOptions& options_;
  Candidates candidates_;
  std::vector<std::unique_ptr<ShortestPaths>> paths_;    // per thread
  std::vector<std::unique_ptr<PatchBounder>> bounders_;  // per thread, made when needed
  std::vector<std::vector<double>> distances_;           // per source of a round
  double extent_ = 0;  // how far the farthest triangle is from some triangle
  double done_ = 0;    // as progress
  bool ties_settled_ = false;
  double patch_reach_ = 0;
  std::size_t patch_most_ = kMostInPatch;
  std::uint64_t work_ = 0;  // sources x rows
};

}  // namespace

StartTriangle find_start_triangle(const DualGraph& graph, std::span<const double> areas,
                                  std::span<const std::uint32_t> indices, const StartSearchOptions& options) {
  if (graph.triangles == 1) return {};
  return StartSearch(graph, areas, indices, options).run();
}

}  // namespace scene_analyzer::surface_distances
