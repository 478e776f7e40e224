// Pictures: decoded to a bounded size, or refused with a phrase.
#include "import/image_builder.h"
#include "import/texture_decoder.h"
#include "mesh/scene.h"
#include "target.h"

namespace scene_analyzer::fuzz {

std::vector<std::string> seeds() {
  using namespace std::string_literals;
  const import::Pixels pixels = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}, {13, 14, 15, 16}};
  return {import::png(2, 2, pixels), import::tga(2, 2, pixels), import::plain_tga(16, 16, {1, 2, 3, 4}),
          import::bmp(2, 2, pixels),
          // The smallest GIF, and a PSD of one pixel.
          "GIF89a\1\0\1\0\x80\0\0\xFF\xFF\xFF\0\0\0,\0\0\0\0\1\0\1\0\0\2\2D\1\0;"s,
          "8BPS\0\1\0\0\0\0\0\0\0\3\0\0\0\1\0\0\0\1\0\x08\0\3\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x10\x20\x30"s};
}

}  // namespace scene_analyzer::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scene_analyzer;
  constexpr std::uint64_t kMostPixels = 1 << 16;  // large pictures take long and do the same
  try {
    const import::DecodedImage image = import::decode_image({data, size}, kMostPixels);
    fuzz::require(image.width >= 1 && image.width <= mesh::kLongestTextureSide, "a width within the limit");
    fuzz::require(image.height >= 1 && image.height <= mesh::kLongestTextureSide,
                  "a height within the limit");
    fuzz::require(image.pixels.size() == std::size_t{4} * image.width * image.height, "all pixels are there");
  } catch (const import::NotDecodable& error) {
    fuzz::require(*error.what() != '\0', "a refusal has a reason");
  }
  return 0;
}
