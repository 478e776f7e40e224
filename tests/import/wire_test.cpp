// The parent must survive whatever a taken-over worker writes.
#include "import/wire.h"

#include <gtest/gtest.h>

#include <random>

#include "base/error.h"
#include "import/scene_wire.h"
#include "import/wire_builder.h"

namespace scene_analyzer::import {
namespace {

mesh::Scene read(std::span<const std::byte> memory) {
  wire::Reader reader(memory);
  if (reader.status() != wire::Status::kScene) throw wire::Malformed("another status");
  return read_scene(reader);
}

TEST(Wire, RoundTrip) {
  const std::vector<std::byte> memory = small_scene();
  const mesh::Scene scene = read(memory);
  EXPECT_EQ(scene.format, "Test");
  EXPECT_EQ(scene.unit_scale, 0.01);
  EXPECT_EQ(scene.up_axis, "+Z");
  EXPECT_EQ(scene.files.at(0).path, "a.obj");
  EXPECT_EQ(scene.warnings.at(0), "careful");
  EXPECT_EQ(scene.textures.at(0).path, "wood.png");
  EXPECT_EQ(scene.textures.at(0).encoded.size(), 2u);
  EXPECT_EQ(scene.textures.at(0).width, 2u);
  EXPECT_EQ(scene.textures.at(0).height, 1u);
  EXPECT_EQ(scene.textures.at(0).pixels[7], 8u);
  EXPECT_EQ(scene.meshes.at(0).name, "triangle");
  EXPECT_EQ(scene.meshes.at(0).positions[7], 1.0f);
  EXPECT_EQ(scene.meshes.at(0).indices[2], 2u);
  EXPECT_TRUE(scene.meshes.at(0).texture_coordinates.empty());
  EXPECT_EQ(scene.meshes.at(0).skipped_primitives, 7u);
  EXPECT_EQ(scene.instances.at(0).world, mesh::kIdentity4);
}

TEST(Wire, ArraysAreUsedWhereTheyLie) {
  const std::vector<std::byte> memory = small_scene();
  const mesh::Scene scene = read(memory);
  const auto* position = reinterpret_cast<const std::byte*>(scene.meshes.at(0).positions.data());
  EXPECT_GE(position, memory.data());
  EXPECT_LT(position, memory.data() + memory.size());
  EXPECT_EQ((position - memory.data()) % 64, 0);
}

TEST(Wire, AnIndexBeyondTheVerticesNamesMeshAndTriangle) {
  const std::vector<std::byte> memory = small_scene(3);
  try {
    read(memory);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "triangle 0 of mesh 0 \"triangle\" asks for vertex 3 of 3");
  }
}

TEST(Wire, ATextureIsNeitherLargerNorOfAnotherSizeThanItsPixels) {
  using Pixels = std::vector<std::uint8_t>;
  const auto read_texture = [](const TextureRecord& texture) { read(small_scene(2, texture)); };
  EXPECT_NO_THROW(read_texture({0, 0, {}}));
  EXPECT_NO_THROW(read_texture({1024, 1024, Pixels(4 << 20)}));
  EXPECT_THROW(read_texture({1025, 1, Pixels(4 * 1025)}), wire::Malformed);
  EXPECT_THROW(read_texture({1, 1025, Pixels(4 * 1025)}), wire::Malformed);
  EXPECT_THROW(read_texture({2, 1, Pixels(7)}), wire::Malformed);
  EXPECT_THROW(read_texture({2, 1, Pixels(9)}), wire::Malformed);
  EXPECT_THROW(read_texture({2, 1, {}}), wire::Malformed);
  EXPECT_THROW(read_texture({0, 0, Pixels(4)}), wire::Malformed);
  EXPECT_THROW(read_texture({5, 0, {}}), wire::Malformed);
  EXPECT_THROW(read_texture({0x80000000, 0x80000000, {}}), wire::Malformed) << "4 * 2^62 is 0 in 64 bits";
}

TEST(Wire, EveryTruncationIsRefused) {
  const std::vector<std::byte> memory = small_scene();
  for (std::size_t size = 0; size < memory.size(); ++size)
    EXPECT_THROW(read(std::span(memory).first(size)), wire::Malformed) << size;
}

TEST(Wire, HeaderAloneTellsThatMemoryRanOut) {
  const MemoryFile memory;
  ASSERT_TRUE(wire::write_header_only(memory.descriptor(), wire::Status::kOutOfMemory));
  EXPECT_EQ(wire::Reader(memory.contents()).status(), wire::Status::kOutOfMemory);
}

TEST(Wire, NoByteCanBreakTheReader) {
  const std::vector<std::byte> original = small_scene();
  std::mt19937 random(7);
  std::size_t refused = 0, read_fine = 0;
  for (int round = 0; round < 50000; ++round) {
    std::vector<std::byte> memory = original;
    for (unsigned changes = 1 + random() % 4; changes > 0; --changes)
      memory[random() % memory.size()] = static_cast<std::byte>(random() % 3 == 0 ? 0xFF : random() % 256);
    try {
      touch(read(memory));
      ++read_fine;
    } catch (const wire::Malformed&) {
      ++refused;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000u);
  EXPECT_GT(read_fine, 1000u);
}

}  // namespace
}  // namespace scene_analyzer::import
