#include "render_timing/render_timer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <utility>

#include "gpu/error.h"
#include "interface/render_timing.h"
#include "render_timing/estimate.h"
#include "render_timing/mesh_group.h"
// Generated:
#include "count_covered.spv.h"
#include "timed_mesh_frag.spv.h"
#include "timed_mesh_vert.spv.h"

namespace scene_analyzer::render_timing {
namespace {

using analysis::RenderingTime;
using interface::render_timing::CountCoveredParams;
using interface::render_timing::TimedDrawParams;
using Clock = std::chrono::steady_clock;

// One submission: short enough to be interrupted, long enough not to cost time itself.
constexpr double kSecondsPerSubmission = 0.1;
constexpr std::uint32_t kDrawsPerSubmission = 256;
// More rounds would not be more precise but in their own noise.
constexpr std::uint32_t kMostRounds = 200;

constexpr double kNoTime = std::numeric_limits<double>::quiet_NaN();

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// What all draws of one measurement share.
struct Studio {
  gpu::Device& device;
  const gpu::RasterPipeline& pipeline;
  const gpu::Kernel& count_covered;
  const TimingOptions& options;
  gpu::RenderTarget target;
  std::array<float, 2> aspect;

  Studio(gpu::Device& on, const gpu::RasterPipeline& with, const gpu::Kernel& counter,
         const TimingOptions& wanted)
      : device(on),
        pipeline(with),
        count_covered(counter),
        options(wanted),
        target(on.make_render_target("render timing", wanted.width, wanted.height)) {
    const auto smaller = static_cast<float>(std::min(wanted.width, wanted.height));
    aspect = {smaller / static_cast<float>(wanted.width), smaller / static_cast<float>(wanted.height)};
  }

  void draw(gpu::Recorder& recorder, const MeshGroup& group, std::size_t mesh,
            std::uint32_t rotation_index) const {
    recorder.clear(target, {0, 0, 0, 0});
    recorder.begin_rendering(target);
    recorder.draw(pipeline,
                  TimedDrawParams{.rotation = rotation(rotation_index, options.steps), .aspect = aspect},
                  group.draw_of(mesh));
    recorder.end_rendering();
  }
};

// The measurement of one group of meshes.
class GroupTiming {
 public:
  GroupTiming(const Studio& studio, const MeshGroup& group, double budget_seconds,
              std::function<void(double)> progress)
      : studio_(studio), group_(group), budget_(budget_seconds), progress_(std::move(progress)) {}

  std::vector<RenderingTime> run() {
    warm_up();
    choose_rotations();
    std::vector<RenderingTime> times(group_.size());
    count(times);
    time_rounds();
    for (std::size_t mesh = 0; mesh < group_.size(); ++mesh) fill(times[mesh], mesh);
    return times;
  }

 private:
  // Draws every mesh once from each of `rotations` directions. `finish(draws)` is called for each part of the
  // sequence that was submitted, with the mesh of every draw.
  template <typename Record, typename Finish>
  void for_all(gpu::Recorder& recorder, std::size_t rotations, Record record, Finish finish) {
    std::vector<std::size_t> order(group_.size()), drawn;
    std::iota(order.begin(), order.end(), std::size_t{0});
    double seconds = 0;
    const auto submit = [&] {
      recorder.submit_and_wait();
      finish(drawn);
      drawn.clear();
      seconds = 0;
      progress_(seconds_since(begin_) / budget_);
    };
    for (std::size_t rotation = 0; rotation < rotations; ++rotation) {
      std::ranges::shuffle(order, random_);
      for (const std::size_t mesh : order) {
        record(mesh, rotation);
        drawn.push_back(mesh);
        seconds += seconds_per_draw_.empty() ? kSecondsPerSubmission : seconds_per_draw_[mesh];
        if (seconds >= kSecondsPerSubmission || drawn.size() == kDrawsPerSubmission) submit();
      }
    }
    if (!drawn.empty()) submit();
  }

  // Everything that is made at a mesh's first draw is made; what drawing takes, waiting included, is known.
  void warm_up() {
    gpu::Recorder recorder(studio_.device);
    const auto record = [&](std::size_t mesh, std::size_t) { studio_.draw(recorder, group_, mesh, 0); };
    for_all(recorder, 1, record, [](const auto&) {});
    std::vector<double> seconds(group_.size());
    Clock::time_point last = Clock::now();
    for_all(recorder, 1, record, [&](const std::vector<std::size_t>& drawn) {
      seconds[drawn.front()] = seconds_since(std::exchange(last, Clock::now()));
    });
    seconds_per_draw_ = std::move(seconds);
  }

  // All, or as many as leave time for one count and one round.
  void choose_rotations() {
    const std::uint32_t all = studio_.options.steps * studio_.options.steps;
    double draws = 0;
    for (const double seconds : seconds_per_draw_) draws += seconds;
    const double possible = (budget_ - seconds_since(begin_)) / (2 * draws);
    const auto count = static_cast<std::uint32_t>(std::clamp<double>(possible, 1, all));
    rotations_ = spread_rotations(count, all);
    samples_.assign(group_.size(), Samples(count));
  }

  void count(std::vector<RenderingTime>& times) {
    const std::uint64_t pixels = studio_.target.color_bytes() / 4;
    const gpu::Array<std::uint32_t> picture(studio_.device, "timed picture", pixels);
    const gpu::Array<std::uint32_t> covered(studio_.device, "covered pixels", group_.size());
    covered.upload(studio_.device, std::vector<std::uint32_t>(group_.size(), 0));
    gpu::Recorder recorder(studio_.device);
    recorder.count_invocations();
    std::vector<gpu::Recorder::DrawCounts> sums(group_.size());
    for_all(
        recorder, rotations_.size(),
        [&](std::size_t mesh, std::size_t r) {
          studio_.draw(recorder, group_, mesh, rotations_[r]);
          recorder.copy_color(studio_.target, picture.buffer());
          recorder.run(
              studio_.count_covered, pixels,
              CountCoveredParams{static_cast<std::uint32_t>(pixels), static_cast<std::uint32_t>(mesh)},
              {picture, covered});
        },
        [&](const std::vector<std::size_t>& drawn) {
          const auto& counts = recorder.draw_counts();
          if (counts.size() != drawn.size()) return;  // the device does not count
          for (std::size_t i = 0; i < drawn.size(); ++i) {
            sums[drawn[i]].vertex_invocations += counts[i].vertex_invocations;
            sums[drawn[i]].fragment_invocations += counts[i].fragment_invocations;
          }
        });
    if (!studio_.device.info().counts_invocations) return;
    const std::vector<std::uint32_t> pixels_covered = covered.download(studio_.device);
    const auto rotations = static_cast<double>(rotations_.size());
    for (std::size_t mesh = 0; mesh < group_.size(); ++mesh) {
      const auto fragments = static_cast<double>(sums[mesh].fragment_invocations);
      times[mesh].vertex_invocations = static_cast<double>(sums[mesh].vertex_invocations) / rotations;
      times[mesh].fragment_invocations = fragments / rotations;
      if (pixels_covered[mesh] > 0) times[mesh].overdraw = fragments / pixels_covered[mesh];
    }
  }

  void time_rounds() {
    gpu::Recorder recorder(studio_.device, true);
    double longest = 0;
    for (std::uint32_t round = 0; round < kMostRounds; ++round) {
      const double before = seconds_since(begin_);
      if (round > 0 && (before + longest > budget_ || all_sure())) return;
      for_all(
          recorder, rotations_.size(),
          [&](std::size_t mesh, std::size_t r) { studio_.draw(recorder, group_, mesh, rotations_[r]); },
          [&](const std::vector<std::size_t>& drawn) {
            for (std::size_t i = 0; i < drawn.size(); ++i)
              samples_[drawn[i]].add(recorder.timings()[i].nanoseconds.value_or(kNoTime));
          });
      longest = std::max(longest, seconds_since(begin_) - before);
    }
  }

  bool all_sure() const {
    return std::ranges::all_of(samples_, [&](const Samples& samples) {
      const auto found = estimate(samples);
      if (!found) return samples.rounds() >= kLeastRounds;  // a clock that fails again and again
      return found->confidence && *found->confidence <= studio_.options.precision * found->mean;
    });
  }

  void fill(RenderingTime& time, std::size_t mesh) const {
    const auto found = estimate(samples_[mesh]);
    if (!found || found->mean <= 0) {
      time = {};
      time.not_measured =
          found ? "the device's clock is too coarse to time a draw" : "the device's timestamps ran backwards";
      return;
    }
    time.mean_ns = found->mean;
    time.confidence_ns = found->confidence;
    time.fastest_ns = found->fastest;
    time.slowest_ns = found->slowest;
    time.rounds = samples_[mesh].rounds();
    time.rotations = samples_[mesh].rotations();
  }

  const Studio& studio_;
  const MeshGroup& group_;
  const double budget_;
  const std::function<void(double)> progress_;
  const Clock::time_point begin_ = Clock::now();
  std::mt19937 random_;  // same seed, same order
  std::vector<double> seconds_per_draw_;
  std::vector<std::uint32_t> rotations_;
  std::vector<Samples> samples_;
};

std::vector<RenderingTime> not_measured(std::size_t count, const std::string& why) {
  RenderingTime none;
  none.not_measured = why;
  return std::vector<RenderingTime>(count, none);
}

// A part of the budget, and of the progress.
struct Share {
  double begin = 0, end = 0;
};

std::vector<RenderingTime> measure_part(const Studio& studio, std::span<const TimedMesh> meshes,
                                        const Share& share) {
  const TimingOptions& options = studio.options;
  try {
    const MeshGroup group(studio.device, meshes);
    const auto report = [&](double fraction) {
      if (options.progress)
        options.progress(share.begin + (share.end - share.begin) * std::min(fraction, 1.0));
    };
    return GroupTiming(studio, group, (share.end - share.begin) * options.budget_seconds, report).run();
  } catch (const gpu::OutOfMemory& error) {
    if (meshes.size() == 1) return not_measured(1, error.what());
  }
  // The device has less than it said. Halves, down to single meshes, so that what fits is measured.
  const std::size_t half = meshes.size() / 2;
  const double middle = (share.begin + share.end) / 2;
  auto times = measure_part(studio, meshes.first(half), {share.begin, middle});
  const auto others = measure_part(studio, meshes.subspan(half), {middle, share.end});
  times.insert(times.end(), others.begin(), others.end());
  return times;
}

}  // namespace

std::string why_not(const gpu::DeviceInfo& device) {
  if (!device.can_draw) return "device " + device.name + " cannot draw";
  if (device.timestamp_bits == 0) return "device " + device.name + " has no timestamps";
  return {};
}

RenderTimer::RenderTimer(gpu::Device& device) : device_(device) {
  if (!why_not(device.info()).empty()) return;
  constexpr gpu::VertexFormat kInputs[] = {gpu::VertexFormat::kFloat3};
  pipeline_ = device.make_raster_pipeline("timed_mesh", {.vertex = timed_mesh_vert_spv,
                                                         .fragment = timed_mesh_frag_spv,
                                                         .inputs = kInputs,
                                                         .push_constant_bytes = sizeof(TimedDrawParams)});
  count_covered_ = device.make_kernel("count_covered", count_covered_spv);
}

std::vector<RenderingTime> RenderTimer::measure(std::span<const TimedMesh> meshes,
                                                const TimingOptions& options) const {
  if (const std::string reason = why_not(device_.info()); !reason.empty())
    return not_measured(meshes.size(), reason);
  const Studio studio(device_, pipeline_, count_covered_, options);
  std::uint64_t all = 0;
  for (const TimedMesh& mesh : meshes) all += mesh.indices.size();
  std::vector<RenderingTime> times;
  Share share;
  for (const GroupRange& range : group_meshes(meshes, device_.info())) {
    const auto part = meshes.subspan(range.first, range.end - range.first);
    std::uint64_t here = 0;
    for (const TimedMesh& mesh : part) here += mesh.indices.size();
    share = {share.end, share.end + static_cast<double>(here) / static_cast<double>(all)};
    const auto measured = measure_part(studio, part, share);
    times.insert(times.end(), measured.begin(), measured.end());
  }
  return times;
}

}  // namespace scene_analyzer::render_timing
