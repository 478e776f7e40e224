// image_builder.h — Small image files, byte by byte, for tests that know every pixel of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scene_analyzer::import {

using Pixel = std::array<std::uint8_t, 4>;  // R, G, B, A
using Pixels = std::vector<Pixel>;          // rows from the top

inline std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFF);
  return bytes;
}

inline std::string little_endian(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i & 0xFF);
  return text;
}

inline std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char c : bytes) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320 : 0);
  }
  return ~crc;
}

inline std::uint32_t adler32(std::string_view bytes) {
  std::uint32_t low = 1, high = 0;
  for (const char c : bytes) {
    low = (low + static_cast<std::uint8_t>(c)) % 65521;
    high = (high + low) % 65521;
  }
  return high << 16 | low;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc32(type + data));
}

// A PNG that says it is `width` by `height` and holds `pixels`, at most 64 KiB of them, uncompressed.
inline std::string png(std::uint32_t width, std::uint32_t height, const Pixels& pixels) {
  std::string rows;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (i % width == 0) rows += '\0';  // no filter
    rows.append(pixels[i].begin(), pixels[i].end());
  }
  const auto bytes = static_cast<std::uint32_t>(rows.size());
  const std::string stored = std::string("\x78\x01\x01") + little_endian(bytes, 2) +
                             little_endian(~bytes & 0xFFFF, 2) + rows + big_endian(adler32(rows));
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR", big_endian(width) + big_endian(height) + std::string("\x08\x06\x00\x00\x00", 5)) +
         png_chunk("IDAT", stored) + png_chunk("IEND", "");
}

// `type`: 2 uncompressed, 10 run lengths. Rows from the top.
inline std::string tga_header(std::uint32_t width, std::uint32_t height, char type) {
  return std::string("\0\0", 2) + type + std::string(9, '\0') + little_endian(width, 2) +
         little_endian(height, 2) + "\x20\x28";
}

inline std::string tga(std::uint32_t width, std::uint32_t height, const Pixels& pixels) {
  std::string file = tga_header(width, height, 2);
  for (const auto& [r, g, b, a] : pixels)
    for (const std::uint8_t channel : {b, g, r, a}) file += static_cast<char>(channel);
  return file;
}

// One colour all over, in 1/100 of the bytes.
inline std::string plain_tga(std::uint32_t width, std::uint32_t height, Pixel color) {
  std::string file = tga_header(width, height, 10);
  const auto [r, g, b, a] = color;
  std::string run = "\xFF";  // 128 pixels
  for (const std::uint8_t channel : {b, g, r, a}) run += static_cast<char>(channel);
  for (std::uint64_t i = 0; i < std::uint64_t{width} * height; i += 128) file += run;
  return file;
}

// 24 bits per pixel, rows from the bottom: alpha is lost.
inline std::string bmp(std::uint32_t width, std::uint32_t height, const Pixels& pixels) {
  std::string rows;
  for (std::uint32_t y = height; y-- > 0;) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const auto [r, g, b, a] = pixels[std::size_t{y} * width + x];
      for (const std::uint8_t channel : {b, g, r}) rows += static_cast<char>(channel);
    }
    rows.resize((rows.size() + 3) / 4 * 4);
  }
  return "BM" + little_endian(static_cast<std::uint32_t>(54 + rows.size()), 4) + little_endian(0, 4) +
         little_endian(54, 4) + little_endian(40, 4) + little_endian(width, 4) + little_endian(height, 4) +
         little_endian(1, 2) + little_endian(24, 2) + std::string(24, '\0') + rows;
}

}  // namespace scene_analyzer::import
