// What pictures cost: memory per triangle, time until a mesh is on the device, time per picture.
//
//   scene-analyzer-bench-pictures [--quick]
//
// Shared: a heightfield whose triangles share vertices; alone: the same with three vertices for every
// triangle, as in STL files. Pictures have 1280 x 720 pixels, with one sample per pixel (the window on
// processors) and four (files), drawn along an orbit; the middle one of 9 counts. The device is the default
// one, or SCENE_ANALYZER_DEVICE.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "device_choice.h"
#include "gpu/device.h"
#include "scene_render/scene_renderer.h"
#include "support/meshes.h"
#include "tables.h"

namespace scene_analyzer::bench {
namespace {

using Clock = std::chrono::steady_clock;
using test_meshes::TestMesh;

constexpr std::uint32_t kWidth = 1280, kHeight = 720;
constexpr std::uint64_t kTargetBytes = 60;

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

mesh::Scene scene_of(const TestMesh& mesh) {
  mesh::Scene scene;
  scene.materials.emplace_back();
  scene.meshes.emplace_back();
  scene.meshes[0].positions = mesh.positions;
  scene.meshes[0].indices = mesh.indices;
  scene.instances.emplace_back();
  return scene;
}

// The median time of a picture along an orbit around the square [0, side]^2 of a heightfield.
double picture_time(scene_render::SceneRenderer& renderer, const scene_render::SceneModel& model,
                    double side) {
  const std::vector<scene_render::Look> looks = {
      {.fill = scene_render::Look::Fill::kColor, .color = {0, 1, 0}}};
  std::vector<double> times;
  for (int i = 0; i < 10; ++i) {
    const double angle = 0.3 * i;
    const scene_render::Camera camera{
        .eye = {side / 2 + side * std::cos(angle), side / 2 + side * std::sin(angle), side},
        .target = {side / 2, side / 2, 0},
        .up = {0, 0, 1},
        .tangent = 0.5};
    const auto begin = Clock::now();
    renderer.draw(model, camera, looks, kWidth, kHeight);
    if (i > 0) times.push_back(milliseconds_since(begin));  // the first one compiles
  }
  std::ranges::nth_element(times, times.begin() + 4);
  return times[4];
}

void run(gpu::Device& device, bool quick) {
  scene_render::SceneRenderer one(device, 1), four(device, 4);
  fmt::print(
      "| triangles | vertices | bytes per triangle (target below {}) | onto the device, ms | 1 sample, ms | "
      "4 samples, ms |\n",
      kTargetBytes);
  fmt::print("|---|---|---|---|---|---|\n");
  for (const std::uint32_t side : {221U, 708U, 1582U}) {
    if (quick && side > 1000) continue;
    const TestMesh shared = test_meshes::heightfield(side, 0.3, 1);
    for (const bool alone : {false, true}) {
      const TestMesh mesh = alone ? test_meshes::unwelded(shared) : shared;
      const mesh::Scene scene = scene_of(mesh);
      const auto begin = Clock::now();
      scene_render::SceneModelBuilder builder(device);
      builder.add(scene);
      const scene_render::SceneModel model = builder.finish();
      const double build = milliseconds_since(begin);
      const double bytes = static_cast<double>(model.bytes()) / static_cast<double>(model.triangles());
      fmt::print("| {} | {} | {:.1f} | {:.0f} | {:.1f} | {:.1f} |\n", model.triangles(),
                 alone ? "alone" : "shared", bytes, build, picture_time(one, model, side),
                 picture_time(four, model, side));
      std::fflush(stdout);
      if (bytes >= static_cast<double>(kTargetBytes)) throw std::runtime_error("too much memory");
    }
  }
}

}  // namespace
}  // namespace scene_analyzer::bench

int main(int argc, char** argv) {
  using namespace scene_analyzer;
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const bool quick = arguments == std::vector<std::string>{"--quick"};
    if (!quick && !arguments.empty()) throw std::runtime_error("the only option is --quick");
    gpu::Device device(bench::device_options());
    bench::print_machine(device.info());
    bench::run(device, quick);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return 1;
  }
}
