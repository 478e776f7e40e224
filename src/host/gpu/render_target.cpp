#include "gpu/render_target.h"

#include <algorithm>
#include <bit>

#include "gpu/error.h"
#include "gpu/native.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::gpu {
RenderTarget::RenderTarget() = default;
RenderTarget::~RenderTarget() = default;
RenderTarget::RenderTarget(RenderTarget&&) noexcept = default;
RenderTarget& RenderTarget::operator=(RenderTarget&&) noexcept = default;

std::uint32_t RenderTarget::width() const {
  return impl_ ? impl_->extent.width : 0;
}
std::uint32_t RenderTarget::height() const {
  return impl_ ? impl_->extent.height : 0;
}

std::uint32_t RenderTarget::samples() const {
  return impl_ ? impl_->samples : 0;
}

RenderTarget Device::make_render_target(const std::string& name, std::uint32_t width, std::uint32_t height,
                                        std::uint32_t samples) {
  const std::string what =
      "picture '" + name + "' of " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (!native_->info.can_draw) throw Error(what + ": device " + native_->info.name + " cannot draw");
  const std::uint32_t most =
      std::min({native_->limits.maxImageDimension2D, native_->limits.maxFramebufferWidth,
                native_->limits.maxFramebufferHeight});
  if (width == 0 || height == 0 || width > most || height > most)
    throw Error(what + ": the device draws 1 to " + std::to_string(most) + " pixels each way");
  if (!std::has_single_bit(samples) ||
      !(sample_count(samples) & native_->limits.framebufferColorSampleCounts &
        native_->limits.framebufferDepthSampleCounts))
    throw Error(what + ": the device does not draw " + std::to_string(samples) + " samples per pixel");
  RenderTarget target;
  target.impl_ = std::make_unique<RenderTarget::Impl>();
  RenderTarget::Impl& impl = *target.impl_;
  impl.name = name;
  impl.extent = vk::Extent2D{width, height};
  impl.samples = samples;
  using Usage = vk::ImageUsageFlagBits;
  using Aspect = vk::ImageAspectFlagBits;
  const auto image = [&](vk::Format format, std::uint32_t samples_each, vk::ImageUsageFlags usage,
                         Aspect aspect) {
    return make_image(*native_,
                      {.format = format,
                       .extent = {width, height, 1},
                       .mipLevels = 1,
                       .samples = sample_count(samples_each),
                       .usage = usage},
                      aspect);
  };
  translated("making " + what, [&] {
    impl.color = image(kColorFormat, samples, Usage::eColorAttachment | Usage::eTransferSrc, Aspect::eColor);
    impl.depth = image(kDepthFormat, samples, Usage::eDepthStencilAttachment, Aspect::eDepth);
    if (samples > 1)
      impl.resolved =
          image(kColorFormat, 1, Usage::eColorAttachment | Usage::eTransferDst | Usage::eTransferSrc,
                Aspect::eColor);
  });
  return target;
}

}  // namespace scene_analyzer::gpu
