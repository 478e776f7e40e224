// drawn_scene.h — A scene of rectangles that face the viewer, and what its picture shows.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/scene.h"
#include "scene_render/scene_renderer.h"

namespace scene_analyzer::test {

using Pixel = std::array<int, 3>;

inline Pixel pixel(const scene_render::Picture& picture, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* at = &picture.rgba[std::size_t{4} * (y * picture.width + x)];
  return {at[0], at[1], at[2]};
}

// How bright what faces the viewer is: scene_mesh.frag's lamp over the shoulder.
inline double facing_shade() {
  return 0.35 + 0.65 / std::hypot(0.3, 0.45, 1.0);
}

inline Pixel shaded(const ratings::Rgb& color, double shade) {
  Pixel result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = static_cast<int>(std::lround(255 * color[i] * shade));
  return result;
}

// The camera looks along -z from z = 10; what it shows at z = 0 is 10 high.
inline scene_render::Camera facing_camera() {
  return {.eye = {0, 0, 10}, .target = {0, 0, 0}, .tangent = 0.5};
}

// A scene to which rectangles in planes of constant z are added: four vertices, two triangles.
class RectangleScene {
 public:
  RectangleScene() { scene_.materials.emplace_back(); }

  // From (left, low) to (right, high). Texture coordinates go from (0, 0) there to (1, 1).
  void add(double left, double low, double right, double high, double z, std::uint32_t material = 0) {
    const auto number = [](double value) { return static_cast<float>(value); };
    auto positions = std::make_shared<std::vector<float>>(
        std::vector<float>{number(left), number(low), number(z), number(right), number(low), number(z),
                           number(right), number(high), number(z), number(left), number(high), number(z)});
    static const std::vector<std::uint32_t> kIndices = {0, 1, 2, 0, 2, 3};
    static const std::vector<float> kCoordinates = {0, 0, 1, 0, 1, 1, 0, 1};
    mesh::TriangleMesh mesh;
    mesh.positions = *positions;
    mesh.indices = kIndices;
    mesh.texture_coordinates = kCoordinates;
    mesh.material = material;
    kept_.push_back(std::move(positions));
    scene_.instances.push_back(
        {.mesh = static_cast<std::uint32_t>(scene_.meshes.size()), .node = "rectangle"});
    scene_.meshes.push_back(std::move(mesh));
  }
  mesh::Scene& scene() { return scene_; }

 private:
  mesh::Scene scene_;
  std::vector<std::shared_ptr<std::vector<float>>> kept_;
};

}  // namespace scene_analyzer::test
