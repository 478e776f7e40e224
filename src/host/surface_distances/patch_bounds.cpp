#include "surface_distances/patch_bounds.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "surface_distances/contraction.h"
#include "surface_distances/sources.h"

namespace scene_analyzer::surface_distances {
namespace {

// Rows up to so many times the members' distance from the middle are searched lane by lane.
constexpr double kNearReach = 1.2;
constexpr std::size_t kParts = 4;  // that a patch is split into
// Fewer triangles are measured one by one.
constexpr std::size_t kLeastTogether = 6;
// Smaller patches are bounded however wide they are.
constexpr std::size_t kLeastTooWide = 256;
// Splits in a row, after which the rest is bounded as it is: patches that do not fall apart lose 16 members
// at a time.
constexpr unsigned kMostSplits = 8;

std::uint32_t count_within(std::span<const double> distances, double reach) {
  return static_cast<std::uint32_t>(std::ranges::count_if(distances, [&](double d) { return d <= reach; }));
}

}  // namespace

template <typename Distance>
PatchBounder::Rows<Distance> PatchBounder::order_around(const Patch& patch, double unit) {
  paths_.run(patch.front(), distances_);
  double radius = 0;
  for (const std::uint32_t node : patch) radius = std::max(radius, distances_[node]);
  Rows<Distance> rows;
  rows.graph = order_by_distance<Distance>(graph_, {distances_, radius}, unit, rows.of_node);
  rows.near = count_within(distances_, kNearReach * radius);
  return rows;
}

PatchBounder::Rows<Units> PatchBounder::begin(const Patch& patch, const Candidates& candidates,
                                              std::vector<Member>& members) {
  candidates_ = &candidates;
  best_ = candidates.best();
  result_ = {};
  result_.work = graph_.nodes();
  Rows<Units> rows = order_around<Units>(patch, unit_);
  for (const std::uint32_t node : patch)
    members.push_back({.row = rows.of_node[node], .node = node, .upper = candidates.upper(node)});
  return rows;
}

PatchResult PatchBounder::bound(const Patch& patch, const Candidates& candidates, const Rules& rules) {
  rules_ = rules;
  std::vector<Member> members;
  const Rows<Units> rows = begin(patch, candidates, members);
  refine(rows.graph, std::move(members), rows.near);
  return std::exchange(result_, {});
}

PatchResult PatchBounder::sample(const Patch& patch, const Candidates& candidates) {
  std::vector<Member> members;
  const Rows<Units> rows = begin(patch, candidates, members);
  for (const Member& open : search(rows.graph, members, rows.near, spread_sources(members)))
    result_.bounds.emplace_back(open.node, open.upper);
  return std::exchange(result_, {});
}

PatchResult PatchBounder::measure(const Patch& patch) {
  return patch.size() < kLeastTogether ? measure_apart(patch) : measure_together(patch);
}

PatchResult PatchBounder::measure_apart(const Patch& patch) {
  PatchResult result;
  for (const std::uint32_t node : patch) {
    paths_.run(node, distances_);
    result.totals.emplace_back(node, total_distance(graph_, distances_));
    result.work += graph_.nodes();
  }
  return result;
}

PatchResult PatchBounder::measure_together(const Patch& patch) {
  const Rows<double> rows = order_around<double>(patch, 1);
  std::vector<std::uint32_t> sources;
  for (const std::uint32_t node : patch) sources.push_back(rows.of_node[node]);
  exact_search_.run(rows.graph, sources, rows.near);
  const std::array<double, kLanes> totals = exact_search_.totals(rows.graph);
  PatchResult result{.totals = {}, .bounds = {}, .work = (1 + patch.size()) * graph_.nodes()};
  for (std::size_t lane = 0; lane < patch.size(); ++lane)
    result.totals.emplace_back(patch[lane], totals[lane]);
  return result;
}

void PatchBounder::refine(const LaneGraph<Units>& rows, std::vector<Member> members, std::uint32_t near) {
  if (result_.work > rules_.most_work || rules_.stop.stop_requested()) return;
  if (depth_ == kMostSplits && members.size() > kLanes) return refine_in_groups(rows, members, near);
  const std::vector<std::size_t> sources = spread_sources(members);
  const std::vector<Member> open = search(rows, members, near, sources);
  if (open.empty()) return;
  double highest = 0;
  for (const std::size_t source : sources) highest = std::max(highest, members[source].upper);
  split(rows, open, std::max(0.0, best_ * (1 - kTie) - highest));
}

void PatchBounder::refine_in_groups(const LaneGraph<Units>& rows, const std::vector<Member>& members,
                                    std::uint32_t near) {
  for (std::size_t begin = 0; begin < members.size(); begin += kLanes) {
    const auto first = members.begin() + static_cast<std::ptrdiff_t>(begin);
    refine(rows, {first, first + static_cast<std::ptrdiff_t>(std::min(kLanes, members.size() - begin))},
           near);
  }
}

// Members far from each other; all of them when they fit.
std::vector<std::size_t> PatchBounder::spread_sources(const std::vector<Member>& members) const {
  if (members.size() <= kLanes) {
    std::vector<std::size_t> all(members.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }
  std::vector<std::uint32_t> nodes;
  nodes.reserve(members.size());
  for (const Member& member : members) nodes.push_back(member.node);
  // Far from everything before, and the most promising one most of all, so that it is the first.
  std::vector<float> nearest(members.size(), std::numeric_limits<float>::max());
  const auto highest = std::ranges::max_element(members, {}, &Member::upper) - members.begin();
  nearest[static_cast<std::size_t>(highest)] = std::numeric_limits<float>::infinity();
  return farthest_apart(nodes, std::move(nearest), *candidates_, kLanes);
}

// Records what a search from the sources proves; returns the members that may still be the start.
std::vector<PatchBounder::Member> PatchBounder::search(const LaneGraph<Units>& rows,
                                                       std::vector<Member>& members, std::uint32_t near,
                                                       const std::vector<std::size_t>& sources) {
  std::vector<std::uint32_t> source_rows;
  for (const std::size_t source : sources) source_rows.push_back(members[source].row);
  if (depth_ == 0 && members.size() >= kLeastTooWide) {
    result_.too_wide = !search_.try_together(rows, source_rows, near);
    if (result_.too_wide) {
      result_.work += std::uint64_t{kLanes} * rows.rows();  // about what was tried
      return {};
    }
  } else {
    search_.run(rows, source_rows, near);
  }
  result_.work += std::uint64_t{sources.size()} * rows.rows();
  const std::array<double, kLanes> totals = search_.totals(rows);
  std::vector<std::uint8_t> is_source(members.size(), 0);
  for (std::size_t lane = 0; lane < sources.size(); ++lane) {
    Member& member = members[sources[lane]];
    is_source[sources[lane]] = 1;
    member.upper = std::min(member.upper, totals[lane] * unit_);
    result_.bounds.emplace_back(member.node, member.upper);
  }
  if (depth_ == 0) {
    const auto highest =
        std::ranges::max_element(sources, {}, [&](std::size_t i) { return members[i].upper; });
    if (members[*highest].upper > best_) raise_best(members[*highest]);
  }
  const double others = graph_.triangles - 2.0;  // see Candidates::bound_all
  std::vector<Member> open;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (is_source[i] != 0) continue;
    Member member = members[i];
    const Lanes<Units>& distances = search_.distances()[member.row];
    for (std::size_t lane = 0; lane < sources.size(); ++lane)
      member.upper = std::min(member.upper, (totals[lane] + others * distances.of[lane]) * unit_);
    if (member.upper >= best_ * (1 - kTie))
      open.push_back(member);
    else
      result_.bounds.emplace_back(member.node, member.upper);
  }
  return open;
}

void PatchBounder::raise_best(Member& member) {
  paths_.run(member.node, distances_);
  member.upper = total_distance(graph_, distances_);
  best_ = std::max(best_, member.upper);
  result_.totals.emplace_back(member.node, member.upper);
  result_.work += graph_.nodes();
}

void PatchBounder::split(const LaneGraph<Units>& rows, const std::vector<Member>& open, double slack) {
  const std::size_t parts = std::min(kParts, (open.size() + kLanes - 1) / kLanes);
  std::vector<std::vector<Member>> part(parts);
  std::vector<std::uint32_t> kept;
  for (const Member& member : open) {
    const auto& distances = search_.distances()[member.row].of;
    const auto end = distances.begin() + static_cast<std::ptrdiff_t>(parts);
    part[static_cast<std::size_t>(std::min_element(distances.begin(), end) - distances.begin())].push_back(
        member);
    kept.push_back(member.row);
  }
  const double tolerance = rules_.slack_share * slack / (graph_.triangles * unit_);
  const Contraction smaller =
      contract(rows, search_.distances(), kept,
               static_cast<Units>(std::min<double>(tolerance, kUnreached<Units> - 1)));
  // The search's distances are overwritten below: what orders the parts is taken out first.
  std::vector<std::vector<double>> order(parts);
  for (std::size_t p = 0; p < parts; ++p)
    for (const std::uint32_t root : smaller.roots) order[p].push_back(search_.distances()[root].of[p]);
  for (std::size_t p = 0; p < parts; ++p) {
    if (part[p].empty()) continue;
    double radius = 0;
    for (const Member& member : part[p]) radius = std::max(radius, order[p][smaller.row[member.row]]);
    std::vector<std::uint32_t> new_row;
    const LaneGraph<Units> ordered = order_by_distance(smaller.graph, {order[p], radius}, new_row);
    for (Member& member : part[p]) member.row = new_row[smaller.row[member.row]];
    ++depth_;
    refine(ordered, std::move(part[p]), count_within(order[p], kNearReach * radius));
    --depth_;
  }
}

}  // namespace scene_analyzer::surface_distances
