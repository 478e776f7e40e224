#include "import/texture_decoder.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

#include "mesh/scene.h"

namespace {

// The library copies nothing to nowhere, which memcpy does not allow, for a PNG whose first piece of data is
// empty.
void* copy_bytes(void* to, const void* from, std::size_t bytes) {
  return bytes == 0 ? to : std::memcpy(to, from, bytes);
}

}  // namespace

// Compiled here instead of linked: memory comes cleared, so that the rest of a picture that ends early is the
// same in every run (the library shows what lay there before), only these formats are read, and nobody opens
// files.
#define memcpy copy_bytes
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_ONLY_GIF
#define STBI_ONLY_PSD
#define STBI_FAILURE_USERMSG
#define STBI_MALLOC(bytes) std::calloc(1, bytes)
#define STBI_REALLOC(pointer, bytes) std::realloc(pointer, bytes)
#define STBI_FREE(pointer) std::free(pointer)
#include <stb_image.h>
#undef memcpy

namespace scene_analyzer::import {
namespace {

struct ImageSize {
  std::uint64_t width = 0, height = 0;
  std::uint64_t pixels() const { return width * height; }
};

ImageSize size_of(std::span<const std::uint8_t> encoded) {
  int width = 0, height = 0, channels = 0;
  if (encoded.size() > std::numeric_limits<int>::max()) throw NotDecodable("its file is larger than 2 GiB");
  if (!stbi_info_from_memory(encoded.data(), static_cast<int>(encoded.size()), &width, &height, &channels) ||
      width <= 0 || height <= 0)
    throw NotDecodable("it is damaged or no PNG, JPEG, BMP, TGA, GIF or PSD; convert it to PNG");
  return {static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height)};
}

void check_size(const ImageSize& size, std::uint64_t most_pixels) {
  const std::string text = std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels";
  if (std::max(size.width, size.height) > kLongestImageSide)
    throw NotDecodable(text + ", and no side may have more than " + std::to_string(kLongestImageSide));
  if (size.pixels() > most_pixels)
    throw NotDecodable(text + ", and no more than " + std::to_string(most_pixels) + " are decoded");
}

std::uint64_t little_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | bytes[i];
  return value;
}

// Bytes that the file of a format without compression, or with run lengths, has at least; 0 for the others.
std::uint64_t least_bytes(std::span<const std::uint8_t> encoded, std::uint64_t pixels) {
  const std::string_view text(reinterpret_cast<const char*>(encoded.data()), encoded.size());
  if (text.starts_with("BM") && encoded.size() >= 30)
    return little_endian(encoded.subspan(10, 4)) + pixels * encoded[encoded[14] == 12 ? 24 : 28] / 8;
  for (const char* const other : {"\x89PNG", "\xFF\xD8", "GIF8", "8BPS"})
    if (text.starts_with(other)) return 0;
  constexpr std::uint64_t kHeader = 18, kLongestRun = 128;
  if (encoded.size() < kHeader) return kHeader;
  const unsigned type = encoded[2] & 7u;  // 1 to 3; with run lengths 9 to 11
  if (type < 1 || type > 3) return 0;
  const std::uint64_t palette = encoded[1] == 0 ? 0 : little_endian(encoded.subspan(5, 2)) * encoded[7] / 8;
  const std::uint64_t bytes_each = (encoded[16] + 7u) / 8;
  const std::uint64_t runs = (pixels + kLongestRun - 1) / kLongestRun;
  return kHeader + encoded[0] + palette +
         ((encoded[2] & 8) != 0 ? runs * (1 + bytes_each) : pixels * bytes_each);
}

// The decoder takes the end of these files for zeros.
void check_is_whole(std::span<const std::uint8_t> encoded, const ImageSize& size) {
  const std::uint64_t needed = least_bytes(encoded, size.pixels());
  if (needed > encoded.size())
    throw NotDecodable("it is damaged: for " + std::to_string(size.width) + " x " +
                       std::to_string(size.height) + " pixels it needs " + std::to_string(needed) +
                       " bytes, and it has " + std::to_string(encoded.size()));
}

std::string explain(const std::string& reason) {
  if (reason == "Out of memory") return "decoding it needs more memory than the import may take";
  return "it is damaged: " + reason;
}

// The means of one row of the result, out of the rows [top, bottom).
void average_rows(std::span<const std::uint8_t> rgba, std::size_t width, std::size_t top, std::size_t bottom,
                  std::span<std::uint8_t> row) {
  const std::size_t boxes = row.size() / 4;
  for (std::size_t box = 0; box < boxes; ++box) {
    const std::size_t left = box * width / boxes, right = (box + 1) * width / boxes;
    std::array<std::uint32_t, 4> sums{};
    for (std::size_t y = top; y < bottom; ++y)
      for (std::size_t i = 4 * (y * width + left); i < 4 * (y * width + right); ++i) sums[i % 4] += rgba[i];
    const auto count = static_cast<std::uint32_t>((bottom - top) * (right - left));
    for (std::size_t channel = 0; channel < 4; ++channel)
      row[4 * box + channel] = static_cast<std::uint8_t>((sums[channel] + count / 2) / count);
  }
}

}  // namespace

DecodedImage shrink(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height,
                    std::uint32_t longest) {
  unsigned halvings = 0;
  while (std::max(width, height) >> halvings > longest) ++halvings;
  DecodedImage result{std::max(width >> halvings, 1u), std::max(height >> halvings, 1u), {}};
  const std::size_t row_bytes = std::size_t{4} * result.width;
  result.pixels.resize(row_bytes * result.height);
  for (std::size_t y = 0; y < result.height; ++y)
    average_rows(rgba, width, y * height / result.height, (y + 1) * height / result.height,
                 std::span(result.pixels).subspan(y * row_bytes, row_bytes));
  return result;
}

DecodedImage decode_image(std::span<const std::uint8_t> encoded, std::uint64_t most_pixels) {
  const ImageSize announced = size_of(encoded);
  check_size(announced, most_pixels);
  check_is_whole(encoded, announced);
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&std::free)> pixels(
      stbi_load_from_memory(encoded.data(), static_cast<int>(encoded.size()), &width, &height, &channels, 4),
      &std::free);
  if (!pixels) throw NotDecodable(explain(stbi_failure_reason()));
  const std::size_t bytes =
      std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return shrink({pixels.get(), bytes}, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                mesh::kLongestTextureSide);
}

}  // namespace scene_analyzer::import
