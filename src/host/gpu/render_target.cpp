#include "gpu/render_target.h"

#include <algorithm>

#include "gpu/error.h"
#include "gpu/native.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::gpu {
namespace {

RenderTarget::Impl::Image make_image(Device::Native& native, vk::Format format, vk::Extent3D extent,
                                     vk::ImageUsageFlags usage, vk::ImageAspectFlags aspect) {
  RenderTarget::Impl::Image made;
  made.image = vk::raii::Image(native.device, {.imageType = vk::ImageType::e2D,
                                               .format = format,
                                               .extent = extent,
                                               .mipLevels = 1,
                                               .arrayLayers = 1,
                                               .usage = usage});
  const vk::MemoryRequirements need = made.image.getMemoryRequirements();
  const auto type = native.memory_types.for_images(need.memoryTypeBits);
  if (!type) throw Error("the device has no memory type for images");
  if (allocation_fails(native.faults)) throw vk::OutOfDeviceMemoryError("asked for by a test");
  made.memory =
      vk::raii::DeviceMemory(native.device, {.allocationSize = need.size, .memoryTypeIndex = *type});
  made.image.bindMemory(*made.memory, 0);
  made.view = vk::raii::ImageView(native.device, {.image = *made.image,
                                                  .viewType = vk::ImageViewType::e2D,
                                                  .format = format,
                                                  .subresourceRange = {aspect, 0, 1, 0, 1}});
  return made;
}

}  // namespace

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

RenderTarget Device::make_render_target(const std::string& name, std::uint32_t width, std::uint32_t height) {
  const std::string what =
      "picture '" + name + "' of " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (!native_->info.can_draw) throw Error(what + ": device " + native_->info.name + " cannot draw");
  const std::uint32_t most =
      std::min({native_->limits.maxImageDimension2D, native_->limits.maxFramebufferWidth,
                native_->limits.maxFramebufferHeight});
  if (width == 0 || height == 0 || width > most || height > most)
    throw Error(what + ": the device draws 1 to " + std::to_string(most) + " pixels each way");
  RenderTarget target;
  target.impl_ = std::make_unique<RenderTarget::Impl>();
  RenderTarget::Impl& impl = *target.impl_;
  impl.name = name;
  impl.extent = vk::Extent2D{width, height};
  const vk::Extent3D extent{width, height, 1};
  using Usage = vk::ImageUsageFlagBits;
  translated("making " + what, [&] {
    impl.color = make_image(*native_, kColorFormat, extent, Usage::eColorAttachment | Usage::eTransferSrc,
                            vk::ImageAspectFlagBits::eColor);
    impl.depth = make_image(*native_, kDepthFormat, extent, Usage::eDepthStencilAttachment,
                            vk::ImageAspectFlagBits::eDepth);
  });
  return target;
}

}  // namespace scene_analyzer::gpu
