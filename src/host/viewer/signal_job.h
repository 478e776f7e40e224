// signal_job.h — The signal behind one mesh's Fourier rating, measured when somebody looks at that mesh: no
// analysis file holds signals. In a thread of its own, so that a window stays responsive.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "analysis/analysis.h"
#include "gpu/device.h"
#include "import/import.h"
#include "mesh/scene.h"
#include "pipeline/measure.h"
#include "report/plot.h"

namespace scene_analyzer::viewer {

// Made small enough to be drawn; in analysed coordinates, not in the world's.
struct SignalCurves {
  std::vector<report::Extremes> areas;       // along the signal
  std::vector<report::Extremes> magnitudes;  // |X_1| .. |X_c|; empty for signals of one value
  std::uint64_t length = 0;                  // N
  double largest_magnitude = 0;              // of |X_1| .. |X_c|, and where it is
  std::uint64_t largest_at = 0;
};
inline constexpr std::size_t kCurveColumns = 256;

class SignalJob {
 public:
  struct Wanted {
    std::size_t asset = 0;       // any number, the same for the same analysis
    std::uint32_t geometry = 0;  // of its analysis, with a signal
    bool operator==(const Wanted&) const = default;
  };
  struct State {
    std::optional<Wanted> wanted;                // what was asked for last
    std::shared_ptr<const SignalCurves> curves;  // its curves; null until they are known
    std::string error;                           // why there will be none
  };

  // The device is made when it is first needed. `on_change` as in ReviewJob: called in the job's thread.
  SignalJob(gpu::DeviceOptions device, import::Limits limits, std::function<void()> on_change = {});
  // Stops as ReviewJob does.
  ~SignalJob();
  SignalJob(const SignalJob&) = delete;
  SignalJob& operator=(const SignalJob&) = delete;

  // Does not wait. What was asked for before is given up, unless it is the same. Cost, in the job's thread:
  // an import where the last one was of another asset, and the measuring of one mesh, start triangle
  // included; memory: the asset's geometry.
  void ask(Wanted wanted, const analysis::AssetAnalysis& analysis);
  // Nothing is wanted any more. What is asked for next is measured, also when it has just failed.
  void give_up();
  State state() const;

  // As ReviewJob has it.
  std::vector<std::string> take_validation_messages();

 private:
  struct Task {
    Wanted wanted;
    analysis::AssetAnalysis analysis;
    std::stop_token stop;
  };
  void run(const std::stop_token& ended);
  void finish(const Task& task, std::shared_ptr<const SignalCurves> curves, std::string error);
  std::shared_ptr<const SignalCurves> measure(const Task& task);
  const mesh::Scene& scene_of(const Task& task);
  void keep_validation_messages();

  const gpu::DeviceOptions device_options_;
  const import::Limits limits_;
  const std::function<void()> on_change_;

  // Of the job's thread.
  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<pipeline::Measurer> measurer_;
  std::optional<std::size_t> imported_;  // the asset in `scene_`
  mesh::Scene scene_;

  mutable std::mutex mutex_;  // of all that follows
  std::condition_variable_any asked_;
  std::optional<Task> next_;
  std::stop_source giving_up_;  // of the task that was asked for last
  State state_;
  std::vector<std::string> validation_messages_;
  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace scene_analyzer::viewer
