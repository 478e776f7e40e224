#include "cooccurrence/histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

#include "bin_triangles.spv.h"
#include "count_neighbour_bins.spv.h"
#include "count_run_bins.spv.h"
#include "group_triangles.spv.h"
#include "interface/cooccurrence.h"
#include "list_pairs.spv.h"
#include "number_run_pairs.spv.h"
#include "pair_neighbours.spv.h"
#include "pair_runs.spv.h"
#include "sum_run_pairs.spv.h"

namespace scene_analyzer::cooccurrence {

using namespace interface::cooccurrence;

namespace {

static_assert(kBins == analysis::kHistogramBins);
constexpr std::uint32_t kCellsOfMesh = kBins * kBins;
constexpr auto kBinBits = static_cast<std::uint32_t>(std::bit_width(kBins - 1));
constexpr std::uint64_t kNoPair = ~std::uint64_t{0};

std::string reason(std::uint64_t pairs, const char* limit_of, std::uint64_t limit) {
  return fmt::format("too many distinct pairs on edges with more than two triangles: {}, limit {}{}", pairs,
                     limit, limit_of);
}

}  // namespace

struct HistogramBuilder::Input {
  gpu::Device& device;
  const geometry::Geometry& geometry;
  const adjacency::Adjacency& adjacency;
  const AreaClasses& classes;

  auto triangles() const { return static_cast<std::uint32_t>(geometry.triangle_count); }
  auto meshes() const { return static_cast<std::uint32_t>(geometry.records.size()); }
};

// A distinct pair of labels as it comes from the device.
struct HistogramBuilder::Pair {
  std::uint32_t row = 0, column = 0;  // groups of the batch
  std::uint64_t count = 0;
};

// Distinct attributes, numbered over the batch by mesh, then value. Classes that were merged have one value
// and are one group.
struct HistogramBuilder::Groups {
  std::vector<double> values;                // per group
  std::vector<std::uint32_t> of_class;       // per class of the batch
  std::vector<std::uint32_t> first_of_mesh;  // per mesh; then the number of groups

  Groups(gpu::Device& device, const AreaClasses& classes) {
    const ClassRange& last = classes.ranges.back();
    const auto class_values = classes.values.download(device, 0, last.first + last.count);
    of_class.resize(class_values.size());
    for (const ClassRange& range : classes.ranges) {
      first_of_mesh.push_back(static_cast<std::uint32_t>(values.size()));
      for (std::uint32_t c = range.first; c < range.first + range.count; ++c) {
        if (c == range.first || class_values[c] != class_values[c - 1]) values.push_back(class_values[c]);
        of_class[c] = static_cast<std::uint32_t>(values.size() - 1);
      }
    }
    first_of_mesh.push_back(static_cast<std::uint32_t>(values.size()));
  }
};

// Pairs of labels to be sorted and added up: key row << label_bits | column, value the place of the weight.
struct HistogramBuilder::PairList {
  std::uint32_t count;
  primitives::KeyedValues keys;
  gpu::Array<std::uint64_t> weights;

  PairList(gpu::Device& device, std::uint32_t size)
      : count(size),
        keys(primitives::make_keyed_values(device, "label pairs", size)),
        weights(device, "pair weights", size) {}
};

HistogramBuilder::HistogramBuilder(gpu::Device& device, const primitives::Scan& scan,
                                   const primitives::RadixSort& sort, HistogramLimits limits)
    : scan_(scan),
      sort_(sort),
      limits_(limits),
      runs_(device, scan, sort),
      bin_triangles_(device.make_kernel("bin_triangles", bin_triangles_spv)),
      group_triangles_(device.make_kernel("group_triangles", group_triangles_spv)),
      count_neighbour_bins_(device.make_kernel("count_neighbour_bins", count_neighbour_bins_spv)),
      count_run_bins_(device.make_kernel("count_run_bins", count_run_bins_spv)),
      sum_run_pairs_(device.make_kernel("sum_run_pairs", sum_run_pairs_spv)),
      number_run_pairs_(device.make_kernel("number_run_pairs", number_run_pairs_spv)),
      pair_neighbours_(device.make_kernel("pair_neighbours", pair_neighbours_spv)),
      pair_runs_(device.make_kernel("pair_runs", pair_runs_spv)),
      list_pairs_(device.make_kernel("list_pairs", list_pairs_spv)) {}

// Sorts the list, adds up equal pairs and appends them to `pairs`.
void HistogramBuilder::add_up(gpu::Recorder& recorder, PairList list, std::uint32_t label_bits,
                              std::vector<Pair>& pairs) const {
  gpu::Device& device = recorder.device();
  const SortedKeysParams params{list.count};
  const auto& weights = recorder.keep(std::move(list.weights));
  const primitives::KeyedValues sorted =
      sort_.record(recorder, std::move(list.keys), params.count, 2 * label_bits);
  const gpu::Array<std::uint32_t> starts(device, "pair starts", params.count + 1);
  runs_.record_starts(recorder, sorted, starts);
  const gpu::Array<std::uint32_t> low(device, "pairs, low words", params.count);
  const gpu::Array<std::uint32_t> high(device, "pairs, high words", params.count);
  const gpu::Array<std::uint64_t> sums(device, "pair sums", params.count);
  recorder.fill(sums, 0);
  recorder.run(list_pairs_, params.count, params,
               {sorted.low, sorted.high, sorted.values, weights, starts, low, high, sums});
  recorder.submit_and_wait();
  const std::uint32_t found = starts.download(device, params.count, 1).front();
  const auto lows = low.download(device, 0, found), highs = high.download(device, 0, found);
  const auto counts = sums.download(device, 0, found);
  const std::uint64_t mask = (std::uint64_t{1} << label_bits) - 1;
  for (std::uint32_t i = 0; i < found; ++i) {
    const std::uint64_t key = std::uint64_t{highs[i]} << 32 | lows[i];
    if (key == kNoPair || counts[i] == 0) continue;
    pairs.push_back({.row = static_cast<std::uint32_t>(key >> label_bits),
                     .column = static_cast<std::uint32_t>(key & mask),
                     .count = counts[i]});
  }
}

void HistogramBuilder::pair_neighbours(const Input& input, const gpu::Array<std::uint32_t>& labels,
                                       std::uint32_t label_bits, std::vector<Pair>& pairs) const {
  const std::uint32_t half_edges = 3 * input.triangles();
  for (std::uint64_t first = 0; first < half_edges; first += limits_.window) {
    const auto here = static_cast<std::uint32_t>(first);
    const std::uint32_t count = std::min(limits_.window, half_edges - here);
    gpu::Recorder recorder(input.device);
    PairList list(input.device, count);
    recorder.run(
        pair_neighbours_, count, PairParams{here, count, 0, label_bits},
        {input.adjacency.twin, labels, list.keys.low, list.keys.high, list.keys.values, list.weights});
    add_up(recorder, std::move(list), label_bits, pairs);
  }
}

// Meshes whose shared edges would give more pairs than the limits allow: 1 in the result.
std::vector<std::uint32_t> HistogramBuilder::refuse(const Input& input, const LabelRuns& runs,
                                                    std::vector<std::string>& refused) const {
  gpu::Recorder recorder(input.device);
  const gpu::Array<std::uint64_t> totals(input.device, "run pairs of meshes", input.meshes());
  recorder.fill(totals, 0);
  recorder.run(sum_run_pairs_, runs.count, RunPairParams{runs.count, runs.label_bits},
               {runs.sorted.low, runs.sorted.high, runs.starts, runs.firsts, input.adjacency.shared.ends,
                input.adjacency.shared.half_edges, input.geometry.mesh_of, totals});
  recorder.submit_and_wait();
  std::vector<std::uint32_t> flags(input.meshes());
  std::uint64_t accepted = 0;
  const auto pairs = totals.download(input.device);
  for (std::uint32_t mesh = 0; mesh < input.meshes(); ++mesh) {
    if (pairs[mesh] > limits_.pairs_of_mesh)
      refused[mesh] = reason(pairs[mesh], "", limits_.pairs_of_mesh);
    else if (accepted + pairs[mesh] > limits_.pairs_of_batch)
      refused[mesh] = reason(accepted + pairs[mesh], " for meshes measured together", limits_.pairs_of_batch);
    else
      accepted += pairs[mesh];
    flags[mesh] = refused[mesh].empty() ? 0 : 1;
  }
  return flags;
}

void HistogramBuilder::pair_runs(const Input& input, const LabelRuns& runs,
                                 const std::vector<std::uint32_t>& refused, std::vector<Pair>& pairs) const {
  gpu::Device& device = input.device;
  const adjacency::SharedEdges& shared = input.adjacency.shared;
  const gpu::Array<std::uint32_t> offsets(device, "run pair offsets", runs.count + std::uint64_t{1});
  {
    gpu::Recorder recorder(device);
    const gpu::Array<std::uint32_t> flags(device, "refused meshes", refused.size());
    flags.upload(device, refused);
    recorder.run(number_run_pairs_, offsets.count(), RunPairParams{runs.count, runs.label_bits},
                 {runs.sorted.low, runs.sorted.high, runs.starts, runs.firsts, shared.ends, shared.half_edges,
                  input.geometry.mesh_of, flags, offsets});
    scan_.record(recorder, offsets, offsets.count());
    recorder.submit_and_wait();
  }
  const std::uint32_t total = offsets.download(device, runs.count, 1).front();
  for (std::uint32_t first = 0; first < total;) {
    const std::uint32_t count = std::min(limits_.window, total - first);
    gpu::Recorder recorder(device);
    PairList list(device, count);
    recorder.run(pair_runs_, count, PairParams{first, count, runs.count, runs.label_bits},
                 {runs.sorted.low, runs.sorted.high, runs.starts, runs.firsts, shared.ends, offsets,
                  list.keys.low, list.keys.high, list.keys.values, list.weights});
    add_up(recorder, std::move(list), runs.label_bits, pairs);
    first += count;
  }
}

// All pairs of the batch, sorted, each once.
std::vector<HistogramBuilder::Pair> HistogramBuilder::find_pairs(const Input& input, const Groups& groups,
                                                                 std::vector<std::string>& refused) const {
  const gpu::Array<std::uint32_t> labels(input.device, "group of triangle", input.triangles());
  const gpu::Array<std::uint32_t> group_of(input.device, "group of class", groups.of_class.size());
  group_of.upload(input.device, groups.of_class);
  gpu::Recorder recorder(input.device);
  recorder.run(group_triangles_, input.triangles(), LabelParams{input.triangles()},
               {input.classes.class_of, group_of, labels});
  recorder.submit_and_wait();
  // One label stays unused, so that all ones are no pair.
  const auto label_bits = static_cast<std::uint32_t>(std::bit_width(groups.values.size()));
  std::vector<Pair> pairs;
  pair_neighbours(input, labels, label_bits, pairs);
  const LabelRuns runs = runs_.find(input.device, input.geometry, input.adjacency.shared, labels, label_bits);
  if (runs.count > 0) pair_runs(input, runs, refuse(input, runs, refused), pairs);

  // Each window came sorted; windows may repeat pairs.
  const auto before = [](const Pair& a, const Pair& b) {
    return std::tie(a.row, a.column) < std::tie(b.row, b.column);
  };
  if (!std::ranges::is_sorted(pairs, before)) std::ranges::sort(pairs, before);
  std::size_t distinct = 0;
  for (const Pair& pair : pairs) {
    if (distinct > 0 && pairs[distinct - 1].row == pair.row && pairs[distinct - 1].column == pair.column)
      pairs[distinct - 1].count += pair.count;
    else
      pairs[distinct++] = pair;
  }
  pairs.resize(distinct);
  return pairs;
}

std::vector<std::uint64_t> HistogramBuilder::count_bins(const Input& input,
                                                        const gpu::Array<std::uint32_t>& labels,
                                                        const LabelRuns& runs, std::uint32_t first_mesh,
                                                        std::uint32_t end_mesh) const {
  const auto& records = input.geometry.records;
  const std::uint32_t first = 3 * records[first_mesh].first_triangle;
  const std::uint32_t end = 3 * (records[end_mesh - 1].first_triangle + records[end_mesh - 1].triangle_count);
  const std::uint32_t first_run = runs.first_of_mesh[first_mesh];
  const std::uint32_t run_count = runs.first_of_mesh[end_mesh] - first_run;
  const adjacency::SharedEdges& shared = input.adjacency.shared;
  const gpu::Array<std::uint64_t> bins(input.device, "histogram bins",
                                       std::uint64_t{end_mesh - first_mesh} * kCellsOfMesh);
  gpu::Recorder recorder(input.device);
  recorder.fill(bins, 0);
  recorder.run(count_neighbour_bins_, end - first, NeighbourBinParams{first, end - first, first_mesh},
               {input.adjacency.twin, input.geometry.mesh_of, labels, bins});
  if (run_count > 0)
    recorder.run(count_run_bins_, run_count, RunBinParams{first_run, run_count, runs.label_bits, first_mesh},
                 {runs.sorted.low, runs.sorted.high, runs.starts, runs.firsts, shared.ends, shared.half_edges,
                  input.geometry.mesh_of, bins});
  recorder.submit_and_wait();
  return bins.download(input.device);
}

void HistogramBuilder::build(gpu::Device& device, const geometry::Geometry& geometry,
                             const adjacency::Adjacency& adjacency, const AreaClasses& classes,
                             const HistogramSink& sink) const {
  const Input input{device, geometry, adjacency, classes};
  const Groups groups(device, classes);
  std::vector<std::string> refused(input.meshes());
  const std::vector<Pair> pairs = find_pairs(input, groups, refused);

  const gpu::Array<std::uint32_t> labels(device, "bin of triangle", input.triangles());
  gpu::Recorder recorder(device);
  recorder.run(bin_triangles_, input.triangles(), LabelParams{input.triangles()},
               {geometry.mesh_of, classes.class_of, classes.values, classes.ranges_on_device, labels});
  recorder.submit_and_wait();
  const LabelRuns runs = runs_.find(device, geometry, adjacency.shared, labels, kBinBits);
  auto pair = pairs.begin();
  for (std::uint32_t first = 0; first < input.meshes(); first += limits_.meshes) {
    const std::uint32_t end = std::min(input.meshes(), first + limits_.meshes);
    const auto bins = count_bins(input, labels, runs, first, end);
    for (std::uint32_t mesh = first; mesh < end; ++mesh) {
      const std::uint32_t group = groups.first_of_mesh[mesh], end_group = groups.first_of_mesh[mesh + 1];
      const auto cells = bins.begin() + std::ptrdiff_t{mesh - first} * kCellsOfMesh;
      Histogram histogram{.values = {groups.values.begin() + group, groups.values.begin() + end_group},
                          .pairs = {},
                          .refused = std::move(refused[mesh]),
                          .bins = {cells, cells + kCellsOfMesh}};
      for (; pair != pairs.end() && pair->row < end_group; ++pair)
        if (histogram.refused.empty())
          histogram.pairs.push_back({pair->row - group, pair->column - group, pair->count});
      sink(mesh, std::move(histogram));
    }
  }
}

}  // namespace scene_analyzer::cooccurrence
