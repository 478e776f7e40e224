#include "import/texture_writer.h"

#include <cstddef>
#include <span>
#include <system_error>

#include "import/mapped_file.h"
#include "import/texture_decoder.h"
#include "import/warnings.h"

namespace scene_analyzer::import {
namespace {

void write_bytes(std::span<const std::uint8_t> bytes, wire::Writer& writer) {
  writer.begin_array();
  writer.append(bytes);
  writer.end_array(1);
}

DecodedImage decode_file(const std::string& file) {
  try {
    return decode_image(MappedFile(file).bytes());
  } catch (const std::system_error& error) {
    throw NotDecodable("it cannot be read: " + error.code().message());
  }
}

// Decodes one texture after the other until the pixels fill what they may.
class Decoder {
 public:
  explicit Decoder(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

  // 0 x 0 when there is nothing to decode, or when it fails.
  DecodedImage decode(const mesh::Texture& texture, const std::string& file) {
    if (texture.encoded.empty() && file.empty()) return {};
    try {
      return decode_within_limit(texture.encoded, file);
    } catch (const NotDecodable& error) {
      failures_.push_back({texture.path, error.what()});
      return {};
    }
  }

  const std::vector<UndecodedTexture>& failures() const { return failures_; }

 private:
  DecodedImage decode_within_limit(std::span<const std::uint8_t> encoded, const std::string& file) {
    DecodedImage image;
    if (!full_) image = encoded.empty() ? decode_file(file) : decode_image(encoded);
    full_ = full_ || image.pixels.size() > most_bytes_ - bytes_;
    if (full_)
      throw NotDecodable("the textures before it fill the limit of " + std::to_string(most_bytes_ >> 20) +
                         " MiB");
    bytes_ += image.pixels.size();
    return image;
  }

  std::uint64_t most_bytes_;
  std::uint64_t bytes_ = 0;
  bool full_ = false;  // what comes now is not even decoded: that alone may take all the time there is
  std::vector<UndecodedTexture> failures_;
};

}  // namespace

void write_textures(const Appearance& appearance, Textures textures, std::vector<std::string>& warnings,
                    wire::Writer& writer, std::uint64_t most_bytes) {
  Decoder decoder(most_bytes);
  writer.number(std::uint64_t{appearance.textures.size()});
  for (std::size_t i = 0; i < appearance.textures.size(); ++i) {
    const mesh::Texture& texture = appearance.textures[i];
    DecodedImage image;
    if (textures == Textures::kDecode) image = decoder.decode(texture, appearance.texture_files[i]);
    writer.string(texture.path);
    write_bytes(texture.encoded, writer);
    writer.number(image.width);
    writer.number(image.height);
    write_bytes(image.pixels, writer);
  }
  warn_about_textures(decoder.failures(), warnings);
}

}  // namespace scene_analyzer::import
