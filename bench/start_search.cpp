// The search for start triangles against all pairs, and the spectra's share of a whole run.
//
//   scene-analyzer-bench-start [--quick] [FILE[@N]...]
//
// FILE: a model whose largest mesh is searched as well, with @N after N subdivisions of every triangle into
// four. Below 20000 triangles all pairs are computed, and a start triangle that is not theirs is an error
// (exit code 1); above, their time is extrapolated from 64 sources. Both sides use all threads and the same
// shortest paths. The device is the default one, or SCENE_ANALYZER_DEVICE.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "device_choice.h"
#include "fourier_share.h"
#include "gpu/device.h"
#include "import/import.h"
#include "start_case.h"
#include "tables.h"

namespace scene_analyzer::bench {
namespace {

using test_meshes::TestMesh;

std::vector<TestMesh> made_here(bool quick) {
  std::vector<TestMesh> meshes{test_meshes::geosphere(20),
                               test_meshes::torus(90, 60),
                               test_meshes::geosphere(44),
                               test_meshes::torus(140, 140),
                               test_meshes::heightfield(100, 0.5, 1),
                               test_meshes::heightfield(707, 0.5, 1)};
  if (quick) return meshes;
  meshes.push_back(test_meshes::geosphere(88));
  meshes.push_back(test_meshes::geosphere(220));
  meshes.push_back(test_meshes::torus(1000, 500));
  return meshes;
}

void print_row(const StartRow& row) {
  fmt::print("| {} | {} | {} | {:.2f} | {}{:.1f} | {:.0f} | {:.2g} |\n", row.name, row.triangles,
             row.searches, row.seconds, row.extrapolated ? "about " : "", row.all_pairs_seconds,
             row.all_pairs_seconds / row.seconds, row.gap);
  std::fflush(stdout);
}

int run(int argc, char** argv) {
  bool quick = false;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i)
    if (std::string(argv[i]) == "--quick")
      quick = true;
    else
      files.emplace_back(argv[i]);
  gpu::Device device(device_options());
  print_machine(device.info());
  fmt::print(
      "\n| mesh | triangles | searches | seconds | all pairs, seconds | times faster | gap |\n"
      "|---|--:|--:|--:|--:|--:|--:|\n");
  StartBench bench(device);
  for (TestMesh& mesh : made_here(quick)) print_row(bench.run(mesh));
  for (const std::string& file : files) print_row(bench.run(load(file)));
  print_fourier_share(device);
  return 0;
}

}  // namespace
}  // namespace scene_analyzer::bench

int main(int argc, char** argv) {
  try {
    if (argc > 1 && std::string(argv[1]) == scene_analyzer::import::kWorkerArgument)
      return scene_analyzer::import::worker_main(argc, argv);
    return scene_analyzer::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "bench: " << error.what() << "\n";
    return 1;
  }
}
