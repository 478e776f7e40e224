// wire_builder.h — What a worker writes for a small scene, and a look at everything that a scene gives access
// to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "import/memory_file.h"
#include "import/wire.h"
#include "mesh/scene.h"

namespace scene_analyzer::import {

template <typename T>
void write_array(wire::Writer& writer, const std::vector<T>& values) {
  writer.begin_array();
  writer.append(std::span<const T>(values));
  writer.end_array(sizeof(T));
}

struct TextureRecord {
  std::uint32_t width = 2, height = 1;
  std::vector<std::uint8_t> pixels = {1, 2, 3, 4, 5, 6, 7, 8};
};

// One triangle, one texture, one material with colour, one instance; `last_index` is its last corner.
inline std::vector<std::byte> small_scene(std::uint32_t last_index = 2, const TextureRecord& texture = {}) {
  const MemoryFile memory;
  wire::Writer writer(memory.descriptor());
  writer.string("Test");
  writer.number(std::uint8_t{1});
  writer.number(0.01);
  writer.number(std::uint8_t{1});
  writer.string("+Z");
  writer.number(std::uint64_t{1});
  writer.string("a\x1b.obj");
  writer.number(std::uint8_t{1});
  writer.number(std::uint64_t{1});
  writer.string("wood.png");
  write_array<std::uint8_t>(writer, {0x89, 'P'});
  writer.number(texture.width);
  writer.number(texture.height);
  write_array<std::uint8_t>(writer, texture.pixels);
  writer.number(std::uint64_t{1});
  writer.string("red");
  writer.number(std::uint8_t{1});
  for (const float channel : {1.0f, 0.0f, 0.0f, 1.0f}) writer.number(channel);
  writer.number(std::uint8_t{0});
  writer.number(std::uint32_t{0});
  writer.number(std::uint64_t{1});
  writer.string("careful");
  writer.number(std::uint64_t{1});
  writer.string("triangle");
  write_array<float>(writer, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  write_array<std::uint32_t>(writer, {0, 1, last_index});
  write_array<float>(writer, {});
  writer.number(std::uint32_t{0});
  writer.number(std::uint64_t{7});
  writer.number(std::uint64_t{1});
  writer.number(std::uint32_t{0});
  writer.string("node");
  for (const double element : mesh::kIdentity4) writer.number(element);
  writer.finish(wire::Status::kScene);
  return memory.contents();
}

// Reads everything that a scene gives access to, so that a sanitizer sees a span that leads out.
inline std::uint64_t touch(const mesh::Scene& scene) {
  std::uint64_t sum = scene.files.size() + scene.warnings.size();
  for (const mesh::TriangleMesh& mesh : scene.meshes) {
    for (const std::uint32_t index : mesh.indices) sum += mesh.positions[3 * std::size_t{index}] > 0;
    for (const float value : mesh.texture_coordinates) sum += value > 0;
  }
  for (const mesh::Texture& texture : scene.textures) {
    for (const std::uint8_t byte : texture.encoded) sum += byte;
    for (std::size_t i = 0; i < std::size_t{4} * texture.width * texture.height; ++i)
      sum += texture.pixels[i];
  }
  for (const mesh::Instance& instance : scene.instances)
    sum += scene.meshes.at(instance.mesh).triangle_count();
  return sum;
}

}  // namespace scene_analyzer::import
