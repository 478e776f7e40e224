// What becomes of the pixels of one image.
#include "import/texture_decoder.h"

#include <gmock/gmock.h>

#include <string>

#include "import/image_builder.h"

namespace scene_analyzer::import {
namespace {

using testing::ElementsAre;

// One channel of each pixel, the others zero.
DecodedImage shrink_grey(const std::vector<std::uint8_t>& values, std::uint32_t width, std::uint32_t height,
                         std::uint32_t longest) {
  std::vector<std::uint8_t> rgba(4 * values.size());
  for (std::size_t i = 0; i < values.size(); ++i) rgba[4 * i + 1] = values[i];
  DecodedImage image = shrink(rgba, width, height, longest);
  for (std::size_t i = 0; i < image.pixels.size() / 4; ++i) image.pixels[i] = image.pixels[4 * i + 1];
  image.pixels.resize(image.pixels.size() / 4);
  return image;
}

DecodedImage decode(const std::string& file) {
  return decode_image({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()});
}

TEST(Shrink, SmallEnoughImagesStayAsTheyAre) {
  const DecodedImage image = shrink_grey({1, 2, 3, 4, 5, 6}, 3, 2, 3);
  EXPECT_EQ(image.width, 3u);
  EXPECT_EQ(image.height, 2u);
  EXPECT_THAT(image.pixels, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(Shrink, OddSizesLoseNoPixel) {
  // Boxes of 2 and 3.
  const DecodedImage five = shrink_grey({10, 20, 30, 40, 80}, 5, 1, 4);
  EXPECT_EQ(five.width, 2u);
  EXPECT_THAT(five.pixels, ElementsAre(15, 50));
  const DecodedImage three = shrink_grey({0, 0, 0, 0, 90, 0, 0, 0, 0}, 3, 3, 2);
  EXPECT_EQ(three.width, 1u);
  EXPECT_EQ(three.height, 1u);
  EXPECT_THAT(three.pixels, ElementsAre(10));
}

TEST(Shrink, ManyHalvingsAreRoundedOnce) {
  // One after the other, each rounding up, they would give 1.
  const DecodedImage image = shrink_grey({1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, 16, 1, 1);
  EXPECT_THAT(image.pixels, ElementsAre(0));
}

TEST(Shrink, AThinImageKeepsAPixel) {
  const DecodedImage image = shrink_grey({8, 8, 8, 8, 2, 2, 2, 2}, 1, 8, 2);
  EXPECT_EQ(image.width, 1u);
  EXPECT_EQ(image.height, 2u);
  EXPECT_THAT(image.pixels, ElementsAre(8, 2));
}

TEST(DecodeImage, TheLongestSideIsTaken) {
  const DecodedImage image = decode(plain_tga(16384, 2, {1, 2, 3, 4}));
  EXPECT_EQ(image.width, 1024u);
  EXPECT_EQ(image.height, 1u);
  EXPECT_THAT(std::vector(image.pixels.end() - 4, image.pixels.end()), ElementsAre(1, 2, 3, 4));
}

TEST(DecodeImage, EveryTruncationEnds) {
  const Pixels pixels(16, Pixel{200, 100, 50, 25});
  for (const std::string& file :
       {png(4, 4, pixels), tga(4, 4, pixels), bmp(4, 4, pixels), plain_tga(16, 16, pixels[0])})
    for (std::size_t size = 0; size < file.size(); ++size) {
      try {
        decode(file.substr(0, size));
      } catch (const NotDecodable&) {  // NOLINT(bugprone-empty-catch): one of the two ends it may take
      }
    }
}

// Found by fuzzing: the decoder makes millions of pixels out of the end of such a file.
TEST(TextureDecoder, RunLengthsThatCannotReachTheSizeAreRefused) {
  std::string file = plain_tga(1024, 1024, {1, 2, 3, 4});
  const auto decode = [](const std::string& bytes) {
    return decode_image({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  };
  EXPECT_EQ(decode(file).width, 1024u);
  EXPECT_THROW(decode(file.substr(0, file.size() - 1)), NotDecodable);
  EXPECT_THROW(decode(tga_header(8192, 8192, 10)), NotDecodable);
  EXPECT_THROW(decode(tga_header(8192, 8192, 10).substr(0, 17)), NotDecodable);
}

}  // namespace
}  // namespace scene_analyzer::import
