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
#include "subject.h"
#include "tables.h"

namespace scene_analyzer::bench {
namespace {

struct Measured {
  std::vector<Row> rows;
  std::vector<KernelTable> kernels;
  bool failed = false;
};

gpu::DeviceOptions device_options() {
  gpu::DeviceOptions options;
  if (const char* selector = std::getenv("SCENE_ANALYZER_DEVICE")) options.selector = selector;
  return options;
}

class Runner {
 public:
  Runner() : bench_{.device = gpu::Device(device_options())} {}

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
    benchmark::RegisterBenchmark((one.name + "/" + stage).c_str(),
                                 [this, &one, stage, time](benchmark::State& state) {
                                   guarded(state, [&] {
                                     Subject& subject = subject_of(one);
                                     time(subject);  // caches, page tables and clocks as warm as they will be
                                     Row row{.which = one.name,
                                             .stage = stage,
                                             .triangles = subject.triangles(),
                                             .peak_bytes = subject.peak_bytes()};
                                     for (auto _ : state) {
                                       row.rounds.push_back(time(subject));
                                       state.SetIterationTime(row.rounds.back().device);
                                     }
                                     state.counters["twin_ms"] = row.least().twin * 1e3;
                                     state.counters["ratio"] = row.ratio();
                                     state.counters["ns/triangle"] =
                                         row.least().device * 1e9 / static_cast<double>(row.triangles);
                                     measured_.rows.push_back(std::move(row));
                                   });
                                 })
        ->Iterations(one.rounds)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }

  void add_kernels(const Case& one) {
    benchmark::RegisterBenchmark((one.name + "/kernels").c_str(),
                                 [this, &one](benchmark::State& state) {
                                   guarded(state, [&] {
                                     Subject& subject = subject_of(one);
                                     KernelTable table{
                                         .which = one.name, .triangles = subject.triangles(), .stages = {}};
                                     for (auto _ : state)
                                       for (std::size_t i = 0; i < kStageCount; ++i)
                                         table.stages.push_back(subject.profile(static_cast<Stage>(i)));
                                     measured_.kernels.push_back(std::move(table));
                                   });
                                 })
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
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

  Bench bench_;
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
