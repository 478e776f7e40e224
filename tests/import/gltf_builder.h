// gltf_builder.h — Small valid glTF files for tests to break.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace scene_analyzer::import {

inline std::string base64(std::span<const std::uint8_t> bytes) {
  static constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) { return i + k < bytes.size() ? std::uint32_t{bytes[i + k]} : 0u; };
    const std::uint32_t word = at(0) << 16 | at(1) << 8 | at(2);
    for (int shift = 18; shift >= 0; shift -= 6) text += kAlphabet[word >> shift & 63];
  }
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  for (std::size_t i = 0; i < padding; ++i) text[text.size() - 1 - i] = '=';
  return text;
}

// One quad of two triangles: vertices (0,0,0) (1,0,0) (1,1,0) (0,1,0), 16-bit indices 0 1 2 0 2 3, one node,
// one scene.
struct QuadGltf {
  std::vector<float> positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  std::vector<std::uint16_t> indices = {0, 1, 2, 0, 2, 3};
  nlohmann::json root;

  QuadGltf() {
    root["asset"]["version"] = "2.0";
    root["scene"] = 0;
    root["scenes"] = {{{"nodes", {0}}}};
    root["nodes"] = {{{"name", "quad"}, {"mesh", 0}}};
    root["meshes"] = {
        {{"name", "Quad"}, {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
    root["accessors"] = {{{"bufferView", 0},
                          {"componentType", 5126},
                          {"count", 4},
                          {"type", "VEC3"},
                          {"min", {0, 0, 0}},
                          {"max", {1, 1, 0}}},
                         {{"bufferView", 1}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}};
    root["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 48}},
                           {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 12}}};
    root["buffers"] = {{{"byteLength", 60}}};
  }

  std::vector<std::uint8_t> buffer() const {
    std::vector<std::uint8_t> bytes(positions.size() * 4 + indices.size() * 2);
    std::memcpy(bytes.data(), positions.data(), positions.size() * 4);
    std::memcpy(bytes.data() + positions.size() * 4, indices.data(), indices.size() * 2);
    return bytes;
  }

  // Everything in one .gltf.
  std::string text() const {
    nlohmann::json whole = root;
    if (!whole["buffers"][0].contains("uri"))
      whole["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(buffer());
    return whole.dump();
  }

  // The same as .glb.
  std::string binary() const {
    std::string json = root.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::vector<std::uint8_t> bytes = buffer();
    std::string file = "glTF";
    const auto word = [&](std::uint64_t value) {
      for (int shift = 0; shift < 32; shift += 8) file += static_cast<char>(value >> shift & 0xFF);
    };
    word(2);
    word(12 + 8 + json.size() + 8 + bytes.size());
    word(json.size());
    file += "JSON" + json;
    word(bytes.size());
    file += std::string("BIN\0", 4) + std::string(bytes.begin(), bytes.end());
    return file;
  }
};

}  // namespace scene_analyzer::import
