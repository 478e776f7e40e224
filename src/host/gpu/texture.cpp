#include "gpu/texture.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include "gpu/error.h"
#include "gpu/native.h"
#include "gpu/run_now.h"

namespace scene_analyzer::gpu {
namespace {

using Layout = vk::ImageLayout;

struct Level {
  std::uint32_t width, height;
  std::vector<std::uint8_t> rgba;
};

// Half as wide and high, at least 1: averages of the pixels that a smaller one covers.
Level halved(const Level& level) {
  Level half{std::max(1u, level.width / 2), std::max(1u, level.height / 2), {}};
  half.rgba.resize(std::size_t{4} * half.width * half.height);
  for (std::uint32_t y = 0; y < half.height; ++y)
    for (std::uint32_t x = 0; x < half.width; ++x)
      for (std::uint32_t channel = 0; channel < 4; ++channel) {
        const std::uint32_t x1 = std::min(2 * x + 1, level.width - 1),
                            y1 = std::min(2 * y + 1, level.height - 1);
        const auto at = [&](std::uint32_t column, std::uint32_t row) {
          return level.rgba[4 * (std::size_t{row} * level.width + column) + channel];
        };
        half.rgba[4 * (std::size_t{y} * half.width + x) + channel] = static_cast<std::uint8_t>(
            (at(2 * x, 2 * y) + at(x1, 2 * y) + at(2 * x, y1) + at(x1, y1) + 2) / 4);
      }
  return half;
}

void make_objects(Device::Native& native, std::uint32_t width, std::uint32_t height, std::uint32_t levels,
                  Texture::Impl& texture) {
  texture.image =
      make_image(native,
                 {.format = kColorFormat,
                  .extent = {width, height, 1},
                  .mipLevels = levels,
                  .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst},
                 vk::ImageAspectFlagBits::eColor);
  // Devices allow few samplers, and all textures want the same.
  if (*native.sampler == vk::Sampler{})
    native.sampler = vk::raii::Sampler(native.device, {.magFilter = vk::Filter::eLinear,
                                                       .minFilter = vk::Filter::eLinear,
                                                       .mipmapMode = vk::SamplerMipmapMode::eLinear,
                                                       .maxLod = VK_LOD_CLAMP_NONE});
}

void upload_level(Device::Native& native, const Texture::Impl& texture, const Level& level,
                  std::uint32_t number) {
  const auto stage = make_buffer_impl(native, "staging of texture '" + texture.name + "'", level.rgba.size(),
                                      BufferKind::kStaging);
  std::memcpy(stage->mapped, level.rgba.data(), level.rgba.size());
  const auto change = [&](const vk::raii::CommandBuffer& commands, Layout from, Layout to) {
    record_layouts(commands, {change_layout(texture.image, vk::ImageAspectFlagBits::eColor, from, to)});
  };
  run_now(native, "uploading texture '" + texture.name + "'", [&](const vk::raii::CommandBuffer& commands) {
    record_barrier(commands);
    if (number == 0) change(commands, Layout::eUndefined, Layout::eTransferDstOptimal);
    commands.copyBufferToImage(
        *stage->buffer, *texture.image.image, Layout::eTransferDstOptimal,
        vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, number, 0, 1},
                            .imageExtent = {level.width, level.height, 1}});
    if (level.width == 1 && level.height == 1)
      change(commands, Layout::eTransferDstOptimal, Layout::eShaderReadOnlyOptimal);
  });
}

}  // namespace

Texture::Texture() = default;
Texture::~Texture() = default;
Texture::Texture(Texture&&) noexcept = default;
Texture& Texture::operator=(Texture&&) noexcept = default;

Texture Device::make_texture(const std::string& name, std::uint32_t width, std::uint32_t height,
                             std::span<const std::uint8_t> rgba) {
  const std::string what =
      "texture '" + name + "' of " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (!native_->info.can_draw) throw Error(what + ": device " + native_->info.name + " cannot draw");
  const std::uint32_t most = native_->limits.maxImageDimension2D;
  if (width == 0 || height == 0 || width > most || height > most)
    throw Error(what + ": the device takes 1 to " + std::to_string(most) + " pixels each way");
  if (rgba.size() != std::size_t{4} * width * height)
    wrong(what, "got " + std::to_string(rgba.size()) + " bytes");
  Texture texture;
  texture.impl_ = std::make_unique<Texture::Impl>();
  texture.impl_->name = name;
  const auto levels = static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
  translated("making " + what, [&] { make_objects(*native_, width, height, levels, *texture.impl_); });
  Level level{width, height, {rgba.begin(), rgba.end()}};
  for (std::uint32_t number = 0; number < levels; ++number) {
    if (number > 0) level = halved(level);
    upload_level(*native_, *texture.impl_, level, number);
  }
  return texture;
}

}  // namespace scene_analyzer::gpu
