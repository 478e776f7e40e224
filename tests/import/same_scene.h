// same_scene.h — Two imports of the same contents, compared to the last bit.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "mesh/scene.h"

namespace scene_analyzer::import {

template <typename T>
bool same_values(std::span<const T> a, std::span<const T> b) {
  return std::ranges::equal(a, b);
}

inline void expect_same_meshes(const mesh::Scene& a, const mesh::Scene& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t i = 0; i < a.meshes.size(); ++i) {
    const mesh::TriangleMesh &one = a.meshes[i], &other = b.meshes[i];
    SCOPED_TRACE(testing::Message() << "mesh " << i);
    EXPECT_EQ(one.name, other.name);
    EXPECT_TRUE(same_values(one.positions, other.positions));
    EXPECT_TRUE(same_values(one.indices, other.indices));
    EXPECT_TRUE(same_values(one.texture_coordinates, other.texture_coordinates));
    EXPECT_EQ(one.material, other.material);
    EXPECT_EQ(one.skipped_primitives, other.skipped_primitives);
  }
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].mesh, b.instances[i].mesh);
    EXPECT_EQ(a.instances[i].node, b.instances[i].node);
    EXPECT_EQ(a.instances[i].world, b.instances[i].world);
  }
}

inline void expect_same_appearance(const mesh::Scene& a, const mesh::Scene& b) {
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    EXPECT_EQ(a.materials[i].name, b.materials[i].name);
    EXPECT_EQ(a.materials[i].base_color, b.materials[i].base_color);
    EXPECT_EQ(a.materials[i].texture, b.materials[i].texture);
  }
  ASSERT_EQ(a.textures.size(), b.textures.size());
  for (std::size_t i = 0; i < a.textures.size(); ++i) {
    SCOPED_TRACE(a.textures[i].path);
    EXPECT_EQ(a.textures[i].path, b.textures[i].path);
    EXPECT_TRUE(same_values(a.textures[i].encoded, b.textures[i].encoded));
    EXPECT_EQ(a.textures[i].width, b.textures[i].width);
    EXPECT_EQ(a.textures[i].height, b.textures[i].height);
    EXPECT_TRUE(same_values(a.textures[i].pixels, b.textures[i].pixels));
  }
}

// All but what the asset is called and what the import took.
inline void expect_same_scene(const mesh::Scene& a, const mesh::Scene& b) {
  expect_same_meshes(a, b);
  expect_same_appearance(a, b);
  ASSERT_EQ(a.files.size(), b.files.size());
  for (std::size_t i = 0; i < a.files.size(); ++i) {
    EXPECT_EQ(a.files[i].path, b.files[i].path);
    EXPECT_EQ(a.files[i].found, b.files[i].found) << a.files[i].path;
  }
  EXPECT_EQ(a.warnings, b.warnings);
  EXPECT_EQ(a.format, b.format);
  EXPECT_EQ(a.unit_scale, b.unit_scale);
  EXPECT_EQ(a.up_axis, b.up_axis);
}

}  // namespace scene_analyzer::import
