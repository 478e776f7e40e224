// texture_decoder.h — An image file in memory -> pixels of a bounded size.
//
// Meant for the worker: what is decoded comes from anywhere, and a decoder is where damaged files do damage.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace scene_analyzer::import {

inline constexpr std::uint32_t kLongestImageSide = 16384;                   // pixels
inline constexpr std::uint64_t kMostImagePixels = std::uint64_t{64} << 20;  // of one image

struct DecodedImage {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  // R, G, B, A per pixel, rows from the top; 4 * width * height
};

// No image, or none that may be decoded; the message is a phrase that follows a colon.
class NotDecodable : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// PNG, JPEG, BMP, TGA, GIF (its first picture) and PSD; 16 bits per channel become 8, grey and palettes
// become RGBA, alpha without such a channel is 255. Sizes are looked at before anything is allocated: throws
// NotDecodable for larger ones than the constants above, for other formats and for damaged files. Not all
// damage is noticed: the rest of a JPEG that ends early is grey. Cost: some 25 ms per million pixels, twice
// that with 16 bits per channel; up to 20 bytes per pixel of the image while it lasts.
DecodedImage decode_image(std::span<const std::uint8_t> encoded,
                          std::uint64_t most_pixels = kMostImagePixels);

// Halves `rgba` (4 * width * height values) as often as it takes until no side is longer than `longest`, at
// once: each pixel of the result is the rounded mean, per channel and of the stored values, of the box of
// pixels that it stands for, 2^k wide and high. Sizes that are no multiple of 2^k are divided rounding down
// (at least 1), and some boxes are larger, so that every pixel counts exactly once and the result shows the
// whole image.
DecodedImage shrink(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height,
                    std::uint32_t longest);

}  // namespace scene_analyzer::import
