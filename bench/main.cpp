// The benchmarks: every case through every stage and the whole recipe, device and twin in turn.
//
// Each google-benchmark case shows the device's time, and beside it as counters the twin's and their ratio.
// Tables for docs/performance.md follow at the end. A result that the twin does not confirm is an error:
// nothing is timed then, and the program ends with 1. The device is the default one, or
// SCENE_ANALYZER_DEVICE.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>

#include "cases.h"
#include "device_choice.h"
#include "subject.h"
#include "tables.h"

namespace scene_analyzer::bench {
namespace {

struct Measured {
  std::vector<Row> rows;
  std::vector<KernelTable> kernels;
  bool failed = false;
};

class Runner {
 public:
  void register_all() {
    for (const Case& one : cases()) {
      add(one, std::string(kWhole), [](Subject& subject) { return subject.time_whole(); });
      for (std::size_t i = 0; i < kStageCount; ++i)
        add(one, std::string(kStageNames[i]),
            [i](Subject& subject) { return subject.time_stage(static_cast<Stage>(i)); });
      if (one.by_kernel) add_kernels(one);
    }
  }

  const Measured& measured() const { return measured_; }
  const gpu::DeviceInfo& device() const { return bench_.device.info(); }

 private:
  template <typename Time>
  void add(const Case& one, const std::string& stage, Time time) {
    const auto run = [this, &one, stage, time](benchmark::State& state) {
      guarded(state, [&] { measure(state, subject_of(one), stage, time); });
    };
    benchmark::RegisterBenchmark((one.name + "/" + stage).c_str(), run)
        ->Iterations(one.rounds)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }

  void add_kernels(const Case& one) {
    const auto run = [this, &one](benchmark::State& state) {
      guarded(state, [&] { measure_kernels(state, subject_of(one)); });
    };
    benchmark::RegisterBenchmark((one.name + "/kernels").c_str(), run)
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  }

  // The subject has run everything once: caches and page tables are as warm as they will be.
  template <typename Time>
  void measure(benchmark::State& state, Subject& subject, const std::string& stage, const Time& time) {
    Row row{.which = subject.which().name,
            .stage = stage,
            .triangles = subject.triangles(),
            .peak_bytes = subject.peak_bytes(),
            .rounds = {}};
    for (auto _ : state) {
      row.rounds.push_back(time(subject));
      state.SetIterationTime(row.rounds.back().device.wall);
    }
    const Round least = row.least();
    state.counters["twin_ms"] = least.twin.wall * 1e3;
    state.counters["ratio"] = row.ratio();
    state.counters["ns/triangle"] = least.device.wall * 1e9 / static_cast<double>(row.triangles);
    measured_.rows.push_back(std::move(row));
  }

  void measure_kernels(benchmark::State& state, Subject& subject) {
    KernelTable table{.which = subject.which().name, .triangles = subject.triangles(), .stages = {}};
    for (auto _ : state)
      for (std::size_t i = 0; i < kStageCount; ++i)
        table.stages.push_back(subject.profile(static_cast<Stage>(i)));
    measured_.kernels.push_back(std::move(table));
  }

  template <typename Work>
  void guarded(benchmark::State& state, const Work& work) {
    try {
      work();
    } catch (const std::exception& error) {
      measured_.failed = true;
      state.SkipWithError(error.what());
    }
  }

  // One case is in memory at a time: benchmarks run in the order of their registration.
  Subject& subject_of(const Case& one) {
    if (!subject_ || &subject_->which() != &one) {
      subject_.reset();
      subject_ = std::make_unique<Subject>(bench_, one);
    }
    return *subject_;
  }

  Bench bench_{.device = gpu::Device(device_options())};
  std::unique_ptr<Subject> subject_;
  Measured measured_;
};

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Runner runner;
  runner.register_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  const Measured& measured = runner.measured();
  if (!measured.rows.empty()) {
    print_machine(runner.device());
    print_rows(measured.rows);
    print_targets(measured.rows);
  }
  for (const KernelTable& table : measured.kernels) print_kernels(table);
  if (measured.failed) std::cerr << "bench: FAILED, see the errors above\n";
  return measured.failed ? 1 : 0;
}

}  // namespace
}  // namespace scene_analyzer::bench

int main(int argc, char** argv) {
  try {
    return scene_analyzer::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "bench: " << error.what() << "\n";
    return 1;
  }
}
