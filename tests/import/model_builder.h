// model_builder.h — Small valid STL and PLY files for tests to break.
#pragma once

#include <cstdint>
#include <string>

namespace scene_analyzer::import {

template <typename T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline std::string binary_stl(std::uint32_t triangles, const std::string& header = "made for a test") {
  std::string bytes = header;
  bytes.resize(80, ' ');
  put(bytes, triangles);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    for (const float value :
         {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f + static_cast<float>(i), 0.f})
      put(bytes, value);
    put(bytes, std::uint16_t{0});
  }
  return bytes;
}

inline std::string binary_ply(std::uint32_t faces) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\ncomment x\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nelement face " +
      std::to_string(faces) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) put(bytes, value);
  for (std::uint32_t i = 0; i < faces; ++i) {
    put(bytes, std::uint8_t{3});
    for (const std::int32_t index : {0, 1, 2}) put(bytes, index);
  }
  return bytes;
}

}  // namespace scene_analyzer::import
