#include "viewer/signal_job.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

#include "gpu/error.h"
#include "pipeline/import_again.h"

namespace scene_analyzer::viewer {
namespace {

using analysis::AssetAnalysis;
using analysis::GeometryAnalysis;

// Leaves the measurement between two steps; not a std::runtime_error, so that no handler of ordinary errors
// takes it.
class GivenUp : public std::exception {
 public:
  const char* what() const noexcept override { return "the signal is no longer wanted"; }
};

SignalCurves curves_of(const analysis::SignalSpectrum& signal) {
  SignalCurves curves;
  curves.length = signal.areas.size();
  if (!signal.areas.empty()) curves.areas = report::envelope(signal.areas, kCurveColumns);
  if (signal.magnitudes.size() < 2) return curves;
  const auto alternating = signal.magnitudes.subspan(1);
  curves.magnitudes = report::envelope(alternating, kCurveColumns);
  const auto largest = std::ranges::max_element(alternating);
  curves.largest_magnitude = *largest;
  curves.largest_at = static_cast<std::uint64_t>(largest - alternating.begin()) + 1;
  return curves;
}

// The mesh alone, standing as it was measured.
mesh::Scene scene_of_one(const mesh::Scene& scene, const GeometryAnalysis& geometry) {
  mesh::Scene one;
  one.asset = scene.asset;
  one.storage = scene.storage;
  one.materials = scene.materials;
  one.meshes.push_back(scene.meshes.at(geometry.mesh));
  mesh::Instance& instance = one.instances.emplace_back();
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      instance.world[4 * row + column] = geometry.linear[3 * row + column];
  return one;
}

}  // namespace

SignalJob::SignalJob(gpu::DeviceOptions device, import::Limits limits, std::function<void()> on_change)
    : device_options_(std::move(device)),
      limits_(std::move(limits)),
      on_change_(std::move(on_change)),
      thread_([this](const std::stop_token& ended) { run(ended); }) {}

SignalJob::~SignalJob() {
  const std::scoped_lock lock(mutex_);
  giving_up_.request_stop();
}

void SignalJob::ask(Wanted wanted, const AssetAnalysis& analysis) {
  {
    const std::scoped_lock lock(mutex_);
    if (state_.wanted == wanted) return;
    giving_up_.request_stop();
    giving_up_ = {};
    state_ = {.wanted = wanted, .curves = {}, .error = {}};
    next_ = {wanted, analysis, giving_up_.get_token()};
  }
  asked_.notify_all();
}

void SignalJob::give_up() {
  const std::scoped_lock lock(mutex_);
  giving_up_.request_stop();
  next_.reset();
  state_ = {};
}

SignalJob::State SignalJob::state() const {
  const std::scoped_lock lock(mutex_);
  return state_;
}

std::vector<std::string> SignalJob::take_validation_messages() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(validation_messages_, {});
}

void SignalJob::run(const std::stop_token& ended) {
  while (true) {
    std::unique_lock lock(mutex_);
    if (!asked_.wait(lock, ended, [this] { return next_.has_value(); })) return;
    const Task task = *std::exchange(next_, std::nullopt);
    lock.unlock();
    try {
      finish(task, measure(task), {});
    } catch (const GivenUp&) {
    } catch (const import::Stopped&) {
    } catch (const gpu::DeviceLost& error) {
      measurer_.reset();
      device_.reset();  // the next wish gets a new one
      finish(task, nullptr, error.what());
    } catch (const std::exception& error) {
      finish(task, nullptr, error.what());
    }
    keep_validation_messages();
  }
}

void SignalJob::finish(const Task& task, std::shared_ptr<const SignalCurves> curves, std::string error) {
  {
    const std::scoped_lock lock(mutex_);
    if (state_.wanted != task.wanted) return;
    state_.curves = std::move(curves);
    state_.error = std::move(error);
  }
  if (on_change_) on_change_();
}

std::shared_ptr<const SignalCurves> SignalJob::measure(const Task& task) {
  const GeometryAnalysis& geometry = task.analysis.geometries.at(task.wanted.geometry);
  const mesh::Scene scene = scene_of_one(scene_of(task), geometry);
  if (!device_) device_ = std::make_unique<gpu::Device>(device_options_);
  if (!measurer_) measurer_ = std::make_unique<pipeline::Measurer>(*device_);
  auto curves = std::make_shared<SignalCurves>();
  AssetAnalysis again;
  measurer_->measure(
      {.scene = scene,
       .analysis = again,
       .parameters = task.analysis.parameters,
       .metrics = analysis::MetricSet().set(index_of(analysis::Metric::kFourierTransform)),
       .progress =
           [&](double, const std::string&) {
             if (task.stop.stop_requested()) throw GivenUp();
           },
       .signals = [&](std::uint32_t,
                      const analysis::SignalSpectrum& signal) { *curves = curves_of(signal); }});
  for (const GeometryAnalysis& measured : again.geometries) {
    if (!measured.not_analysed.empty()) throw std::runtime_error(measured.not_analysed);
    if (!measured.no_fourier_transform.empty()) throw std::runtime_error(measured.no_fourier_transform);
  }
  return curves;
}

const mesh::Scene& SignalJob::scene_of(const Task& task) {
  if (imported_ == task.wanted.asset) return scene_;
  imported_.reset();
  scene_ = {};  // one asset at a time is in memory
  import::Limits limits = limits_;
  limits.stop = task.stop;
  scene_ = pipeline::import_again(task.analysis, limits, import::Textures::kLeave);
  imported_ = task.wanted.asset;
  return scene_;
}

void SignalJob::keep_validation_messages() {
  if (!device_) return;
  std::vector<std::string> messages = device_->take_validation_messages();
  const std::scoped_lock lock(mutex_);
  std::ranges::move(messages, std::back_inserter(validation_messages_));
}

}  // namespace scene_analyzer::viewer
