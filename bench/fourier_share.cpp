#include "fourier_share.h"

#include <fmt/format.h>

#include <vector>

#include "pipeline/measure.h"
#include "spectrum/spectrum.h"
#include "stages.h"
#include "support/scenes.h"

namespace scene_analyzer::bench {
namespace {

constexpr std::uint32_t kMeshes = 20000;
constexpr double kMostShare = 0.1;

std::vector<test_meshes::TestMesh> small_meshes() {
  test_meshes::Random random(kMeshes);
  std::vector<test_meshes::TestMesh> meshes;
  for (std::uint32_t i = 0; i < kMeshes; ++i) {
    const auto side = static_cast<std::uint32_t>(2 + random.below(38));
    meshes.push_back(side == 2 ? test_meshes::cube() : test_meshes::heightfield(side, 0.5, i));
  }
  return meshes;
}

}  // namespace

void print_fourier_share(gpu::Device& device) {
  const mesh::Scene scene = test::scene_of(small_meshes());
  pipeline::Measurer measurer(device);
  const auto measure = [&](const pipeline::SignalSink& sink) {
    analysis::AssetAnalysis analysis;
    measurer.measure({.scene = scene, .analysis = analysis, .signals = sink});
  };
  std::vector<std::vector<double>> signals;
  measure([&](std::uint32_t, const analysis::SignalSpectrum& signal) {
    signals.emplace_back(signal.areas.begin(), signal.areas.end());
  });
  const double whole = elapsed_of([&] { measure({}); }).wall;
  spectrum::SpectrumBuilder spectra(device);
  std::vector<std::span<const double>> samples(signals.begin(), signals.end());
  spectra.transform(std::span(samples).first(1000));  // plans are made once
  const double transforms = elapsed_of([&] { spectra.transform(samples); }).wall;
  std::uint64_t triangles = 0;
  for (const auto& signal : signals) triangles += signal.size();
  fmt::print(
      "\n| figure | value | target | |\n|---|--:|---|---|\n"
      "| spectra of {} meshes of 12 to 3000 triangles ({} in all), share of the whole run of {:.1f} s | "
      "{:.1f} % "
      "| under {:.0f} % | {} |\n",
      signals.size(), triangles, whole, 100 * transforms / whole, 100 * kMostShare,
      transforms < kMostShare * whole ? "met" : "missed");
}

}  // namespace scene_analyzer::bench
