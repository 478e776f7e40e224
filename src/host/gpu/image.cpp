// Images with their memory, and how they lie there.
#include "gpu/error.h"
#include "gpu/native.h"

namespace scene_analyzer::gpu {

Image make_image(Device::Native& native, vk::ImageCreateInfo info, vk::ImageAspectFlags aspect) {
  info.imageType = vk::ImageType::e2D;
  info.extent.depth = 1;
  info.arrayLayers = 1;
  Image made;
  made.image = vk::raii::Image(native.device, info);
  const vk::MemoryRequirements need = made.image.getMemoryRequirements();
  const auto type = native.memory_types.for_images(need.memoryTypeBits);
  if (!type) throw Error("the device has no memory type for images");
  check_free_memory(native.info, "an image", need.size);
  if (allocation_fails(native.faults)) throw vk::OutOfDeviceMemoryError("asked for by a test");
  made.memory =
      vk::raii::DeviceMemory(native.device, {.allocationSize = need.size, .memoryTypeIndex = *type});
  made.image.bindMemory(*made.memory, 0);
  made.view =
      vk::raii::ImageView(native.device, {.image = *made.image,
                                          .viewType = vk::ImageViewType::e2D,
                                          .format = info.format,
                                          .subresourceRange = {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, 1}});
  return made;
}

vk::ImageMemoryBarrier2 change_layout(const Image& image, vk::ImageAspectFlags aspect, vk::ImageLayout from,
                                      vk::ImageLayout to) {
  using Stage = vk::PipelineStageFlagBits2;
  using Access = vk::AccessFlagBits2;
  return {.srcStageMask = Stage::eAllCommands,
          .srcAccessMask = Access::eMemoryWrite,
          .dstStageMask = Stage::eAllCommands,
          .dstAccessMask = Access::eMemoryRead | Access::eMemoryWrite,
          .oldLayout = from,
          .newLayout = to,
          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .image = *image.image,
          .subresourceRange = {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, 1}};
}

void record_layouts(const vk::raii::CommandBuffer& commands,
                    std::initializer_list<vk::ImageMemoryBarrier2> changes) {
  commands.pipelineBarrier2({.imageMemoryBarrierCount = static_cast<std::uint32_t>(changes.size()),
                             .pImageMemoryBarriers = changes.begin()});
}

}  // namespace scene_analyzer::gpu
