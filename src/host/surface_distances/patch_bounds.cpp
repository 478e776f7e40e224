#include "surface_distances/patch_bounds.h"

#include <algorithm>
#include <limits>

#include "surface_distances/contraction.h"

namespace scene_analyzer::surface_distances {
namespace {

// Rows up to so many times the members' distance from the middle are searched lane by lane.
constexpr double kNearReach = 3;
constexpr std::size_t kParts = 4;  // that a patch is split into
// Splits in a row, after which the rest is bounded as it is: patches that do not fall apart would go on for
// ever.
constexpr unsigned kMostSplits = 8;
// Of the way from a patch's totals to the threshold, the part that contraction may use up.
constexpr double kSlackShare = 0.1;

std::uint32_t count_within(std::span<const double> distances, double reach) {
  return static_cast<std::uint32_t>(std::ranges::count_if(distances, [&](double d) { return d <= reach; }));
}

}  // namespace

PatchResult PatchBounder::bound(const std::vector<std::uint32_t>& patch, const Candidates& candidates) {
  candidates_ = &candidates;
  best_ = candidates.best();
  paths_.run(patch.front(), distances_);
  std::vector<std::uint32_t> row_of_node;
  const LaneGraph rows = order_by_distance(graph_, distances_, row_of_node);
  std::vector<Member> members;
  double radius = 0;
  for (const std::uint32_t node : patch) radius = std::max(radius, distances_[node]);
  for (const std::uint32_t node : patch)
    members.push_back({.row = row_of_node[node], .node = node, .upper = candidates.upper(node)});
  PatchResult result;
  result.work = graph_.nodes();
  refine(rows, std::move(members), count_within(distances_, kNearReach * radius), true, result);
  return result;
}

// `whole`: the graph is not contracted, totals are true.
void PatchBounder::refine(const LaneGraph& rows, std::vector<Member> members, std::uint32_t near, bool whole,
                          PatchResult& result) {
  if (depth_ == kMostSplits && members.size() > kLanes) return refine_in_groups(rows, members, near, result);
  const std::vector<std::size_t> sources = spread_sources(members);
  std::vector<std::uint32_t> source_rows;
  for (const std::size_t source : sources) source_rows.push_back(members[source].row);
  search_.run(rows, source_rows, near);
  result.work += std::uint64_t{sources.size()} * rows.rows();
  const std::vector<Member> open = apply_totals(rows, members, sources, whole, result);
  if (open.empty()) return;
  double highest = 0;
  for (const std::size_t source : sources) highest = std::max(highest, members[source].upper);
  const double slack = std::max(0.0, best_ * (1 - kTie) - highest);
  split(rows, open, sources.size(), slack, result);
}

void PatchBounder::refine_in_groups(const LaneGraph& rows, const std::vector<Member>& members,
                                    std::uint32_t near, PatchResult& result) {
  for (std::size_t begin = 0; begin < members.size(); begin += kLanes) {
    const auto first = members.begin() + static_cast<std::ptrdiff_t>(begin);
    refine(rows, {first, first + static_cast<std::ptrdiff_t>(std::min(kLanes, members.size() - begin))}, near,
           false, result);
  }
}

// Members far from each other; all of them when they fit.
std::vector<std::size_t> PatchBounder::spread_sources(const std::vector<Member>& members) const {
  std::vector<std::size_t> sources;
  if (members.size() <= kLanes) {
    for (std::size_t i = 0; i < members.size(); ++i) sources.push_back(i);
    return sources;
  }
  std::vector<float> nearest(members.size(), std::numeric_limits<float>::infinity());
  std::size_t next = 0;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (members[i].upper > members[next].upper) next = i;
  while (sources.size() < kLanes) {
    sources.push_back(next);
    for (std::size_t i = 0; i < members.size(); ++i)
      nearest[i] =
          std::min(nearest[i], candidates_->about_distance(members[i].node, members[sources.back()].node));
    nearest[next] = -1;
    next = static_cast<std::size_t>(std::ranges::max_element(nearest) - nearest.begin());
  }
  return sources;
}

// Records what the search proved; returns the members that may still be the start.
std::vector<PatchBounder::Member> PatchBounder::apply_totals(const LaneGraph& rows,
                                                             std::vector<Member>& members,
                                                             const std::vector<std::size_t>& sources,
                                                             bool whole, PatchResult& result) {
  const std::array<double, kLanes> totals = search_.totals(rows);
  std::vector<std::uint8_t> is_source(members.size(), 0);
  for (std::size_t lane = 0; lane < sources.size(); ++lane) {
    Member& member = members[sources[lane]];
    is_source[sources[lane]] = 1;
    member.upper = whole ? totals[lane] : std::min(member.upper, totals[lane]);
    (whole ? result.totals : result.bounds).emplace_back(member.node, member.upper);
    if (whole) best_ = std::max(best_, totals[lane]);
  }
  const auto n = static_cast<double>(graph_.triangles);
  std::vector<Member> open;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (is_source[i] != 0) continue;
    Member member = members[i];
    const Lanes& distances = search_.distances()[member.row];
    for (std::size_t lane = 0; lane < sources.size(); ++lane)
      member.upper = std::min(member.upper, totals[lane] + n * distances.of[lane]);
    if (member.upper >= best_ * (1 - kTie))
      open.push_back(member);
    else
      result.bounds.emplace_back(member.node, member.upper);
  }
  return open;
}

void PatchBounder::split(const LaneGraph& rows, const std::vector<Member>& open, std::size_t sources,
                         double slack, PatchResult& result) {
  const std::size_t parts = std::min({kParts, sources, (open.size() + kLanes - 1) / kLanes});
  std::vector<std::vector<Member>> part(parts);
  ContractionRules rules;
  std::vector<std::uint32_t> kept;
  std::vector<double> radius(parts, 0);
  for (const Member& member : open) {
    const Lanes& distances = search_.distances()[member.row];
    const auto nearest =
        std::min_element(distances.of.begin(), distances.of.begin() + parts) - distances.of.begin();
    part[static_cast<std::size_t>(nearest)].push_back(member);
    kept.push_back(member.row);
    radius[static_cast<std::size_t>(nearest)] =
        std::max(radius[static_cast<std::size_t>(nearest)],
                 *std::min_element(distances.of.begin(), distances.of.begin() + parts));
    rules.kept_radius = std::max(rules.kept_radius, distances.of[0]);
  }
  rules.kept_rows = kept;
  rules.tolerance = kSlackShare * slack / static_cast<double>(graph_.triangles);
  const Contraction smaller = contract(rows, search_.distances(), rules);
  // The search's distances are overwritten below: what orders the parts is taken out first.
  std::vector<std::vector<double>> order(parts);
  for (std::size_t p = 0; p < parts; ++p)
    for (const std::uint32_t root : smaller.roots) order[p].push_back(search_.distances()[root].of[p]);
  for (std::size_t p = 0; p < parts; ++p) {
    if (part[p].empty()) continue;
    std::vector<std::uint32_t> new_row;
    const LaneGraph ordered = order_by_distance(smaller.graph, order[p], new_row);
    for (Member& member : part[p]) member.row = new_row[smaller.row[member.row]];
    ++depth_;
    refine(ordered, std::move(part[p]), count_within(order[p], kNearReach * radius[p]), false, result);
    --depth_;
  }
}

}  // namespace scene_analyzer::surface_distances
