#include "render_timing/group_timing.h"

#include <chrono>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

#include "gpu/error.h"
#include "interface/render_timing.h"
#include "render_timing/estimate.h"

namespace scene_analyzer::render_timing {
namespace {

using analysis::RenderingTime;
using interface::render_timing::CountCoveredParams;
using interface::render_timing::TimedDrawParams;
using Clock = std::chrono::steady_clock;

// One submission: short enough to be interrupted, long enough not to cost time itself.
constexpr double kSecondsPerSubmission = 0.1;
constexpr std::uint32_t kDrawsPerSubmission = 256;
// Of 4 bytes each, that are kept: where draws take microseconds, these are reached before a long budget's
// end.
constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 25;

constexpr double kNoTime = std::numeric_limits<double>::quiet_NaN();

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// Of all rotations of one mesh.
struct Counts {
  std::uint64_t vertices = 0, fragments = 0, covered = 0;

  void add(const gpu::Recorder::DrawCounts& draw, std::uint32_t pixels) {
    vertices += draw.vertex_invocations;
    fragments += draw.fragment_invocations;
    covered += pixels;
  }
  void fill(RenderingTime& time, std::size_t rotations) const {
    time.vertex_invocations = static_cast<double>(vertices) / static_cast<double>(rotations);
    time.fragment_invocations = static_cast<double>(fragments) / static_cast<double>(rotations);
    if (covered > 0) time.overdraw = static_cast<double>(fragments) / static_cast<double>(covered);
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
    const double possible = (budget_ - seconds_since(begin_)) / (3 * draws);  // counting takes longer
    const auto count = static_cast<std::uint32_t>(std::clamp<double>(possible, 1, all));
    rotations_ = spread_rotations(count, all);
    samples_.assign(group_.size(), Samples(count));
  }

  // What the draws invoke, and how much they cover. That is worth having, but no reason to have no times.
  void count(std::vector<RenderingTime>& times) {
    if (!studio_.device.info().counts_invocations) return;
    try {
      count_draws(times);
    } catch (const gpu::OutOfMemory&) {
      times.assign(times.size(), {});
    }
  }

  void count_draws(std::vector<RenderingTime>& times) {
    const std::uint64_t pixels = studio_.target.color_bytes() / 4;
    const gpu::Array<std::uint32_t> picture(studio_.device, "timed picture", pixels);
    const gpu::Array<std::uint32_t> covered(studio_.device, "covered pixels", kDrawsPerSubmission);
    std::vector<Counts> sums(group_.size());
    gpu::Recorder recorder(studio_.device);
    recorder.count_invocations();
    std::uint32_t slot = 0;  // of the submission at hand
    for_all(
        recorder, rotations_.size(),
        [&](std::size_t mesh, std::size_t r) {
          if (slot == 0) recorder.fill(covered, 0);
          studio_.draw(recorder, group_, mesh, rotations_[r]);
          recorder.copy_color(studio_.target, picture.buffer());
          recorder.run(studio_.count_covered, pixels,
                       CountCoveredParams{static_cast<std::uint32_t>(pixels), slot++}, {picture, covered});
        },
        [&](const std::vector<std::size_t>& drawn) {
          const auto pixels_of = covered.download(studio_.device);
          for (std::size_t i = 0; i < drawn.size(); ++i)
            sums[drawn[i]].add(recorder.draw_counts()[i], pixels_of[i]);
          slot = 0;
        });
    for (std::size_t mesh = 0; mesh < group_.size(); ++mesh) sums[mesh].fill(times[mesh], rotations_.size());
  }

  void time_rounds() {
    gpu::Recorder recorder(studio_.device, true);
    double longest = 0;
    const std::uint64_t samples_per_round = group_.size() * rotations_.size();
    const auto most_rounds = static_cast<std::uint32_t>(
        std::max<std::uint64_t>(kMostSamples / samples_per_round, 2 * kLeastRounds));
    for (std::uint32_t round = 0; round < most_rounds; ++round) {
      const double before = seconds_since(begin_);
      if (round > 0 && (before + longest > budget_ || is_enough(round))) return;
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

  // Whether the times are sure, twice in a row: once may be luck. Looked at ever more rarely, for it costs as
  // much as there are samples.
  bool is_enough(std::uint32_t round) {
    if (round < next_look_) return false;
    next_look_ = round + 1 + round / 16;
    return std::exchange(was_sure_, all_sure()) && was_sure_;
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
  std::uint32_t next_look_ = kLeastRounds;
  bool was_sure_ = false;
  std::mt19937 random_;  // same seed, same order
  std::vector<double> seconds_per_draw_;
  std::vector<std::uint32_t> rotations_;
  std::vector<Samples> samples_;
};

}  // namespace

void Studio::draw(gpu::Recorder& recorder, const MeshGroup& group, std::size_t mesh,
                  std::uint32_t rotation_index) const {
  recorder.clear(target, {0, 0, 0, 0});
  recorder.begin_rendering(target);
  recorder.draw(pipeline,
                TimedDrawParams{.rotation = rotation(rotation_index, options.steps), .aspect = aspect},
                group.draw_of(mesh));
  recorder.end_rendering();
}

std::vector<RenderingTime> time_group(const Studio& studio, const MeshGroup& group, double budget_seconds,
                                      std::function<void(double)> progress) {
  return GroupTiming(studio, group, budget_seconds, std::move(progress)).run();
}

}  // namespace scene_analyzer::render_timing
