#include "gpu/presenter.h"

#include <algorithm>
#include <limits>

#include "gpu/error.h"
#include "gpu/run_now.h"

namespace scene_analyzer::gpu {
namespace {

using Layout = vk::ImageLayout;

// Colours come as they are to be shown: no format that converts them.
std::optional<vk::SurfaceFormatKHR> choose_format(const std::vector<vk::SurfaceFormatKHR>& formats) {
  for (const vk::Format wanted :
       {vk::Format::eB8G8R8A8Unorm, vk::Format::eR8G8B8A8Unorm, vk::Format::eA8B8G8R8UnormPack32})
    for (const vk::SurfaceFormatKHR& format : formats)
      if (format.format == wanted && format.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear) return format;
  return std::nullopt;
}

vk::CompositeAlphaFlagBitsKHR choose_alpha(vk::CompositeAlphaFlagsKHR offered) {
  using Alpha = vk::CompositeAlphaFlagBitsKHR;
  for (const Alpha alpha : {Alpha::eOpaque, Alpha::eInherit, Alpha::ePreMultiplied})
    if (offered & alpha) return alpha;
  return Alpha::ePostMultiplied;
}

// As translated(), for calls that a surface takes part in.
template <typename Call>
auto with_surface(Device::Native& native, const std::string& doing, const Call& call) {
  try {
    return translated(doing, [&] {
      try {
        return call();
      } catch (const vk::SurfaceLostKHRError&) {
        throw Error("the window was lost while " + doing +
                    ": the window system or its display has taken it away. Start again");
      }
    });
  } catch (const DeviceLost&) {
    native.lost = true;
    throw;
  }
}

}  // namespace

struct Presenter::Impl {
  explicit Impl(Device::Native& owner) : native(owner) {}

  Device::Native& native;
  vk::raii::SurfaceKHR surface{nullptr};
  vk::SurfaceFormatKHR format;
  vk::raii::SwapchainKHR swapchain{nullptr};
  std::vector<vk::Image> images;
  vk::Extent2D extent;
  vk::raii::Fence acquired{nullptr};

  // Whether there is a swapchain of the window's size now.
  bool remake(vk::Extent2D wanted);
  std::optional<std::uint32_t> acquire();
  void copy(const RenderTarget::Impl& picture, vk::Image to) const;
  bool hand_over(std::uint32_t index);
};

bool Presenter::Impl::remake(vk::Extent2D wanted) {
  const auto limits = native.physical_device.getSurfaceCapabilitiesKHR(*surface);
  extent = limits.currentExtent;
  if (extent.width == std::numeric_limits<std::uint32_t>::max())
    extent =
        vk::Extent2D{std::clamp(wanted.width, limits.minImageExtent.width, limits.maxImageExtent.width),
                     std::clamp(wanted.height, limits.minImageExtent.height, limits.maxImageExtent.height)};
  images.clear();
  if (extent.width == 0 || extent.height == 0) {
    swapchain = nullptr;
    return false;
  }
  std::uint32_t count = limits.minImageCount + 1;
  if (limits.maxImageCount != 0) count = std::min(count, limits.maxImageCount);
  const vk::raii::SwapchainKHR old = std::move(swapchain);
  swapchain =
      vk::raii::SwapchainKHR(native.device, {.surface = *surface,
                                             .minImageCount = count,
                                             .imageFormat = format.format,
                                             .imageColorSpace = format.colorSpace,
                                             .imageExtent = extent,
                                             .imageArrayLayers = 1,
                                             .imageUsage = vk::ImageUsageFlagBits::eTransferDst,
                                             .preTransform = limits.currentTransform,
                                             .compositeAlpha = choose_alpha(limits.supportedCompositeAlpha),
                                             .presentMode = vk::PresentModeKHR::eFifo,
                                             .clipped = true,
                                             .oldSwapchain = *old});
  const auto handles = swapchain.getImages();
  images.assign(handles.begin(), handles.end());
  return true;
}

// The next image that may be written; nothing when the swapchain no longer fits.
std::optional<std::uint32_t> Presenter::Impl::acquire() {
  constexpr std::uint64_t kLongestWait = 5'000'000'000;  // ns; a compositor that hangs must not hang us
  native.device.resetFences(*acquired);
  try {
    const auto [result, index] = swapchain.acquireNextImage(kLongestWait, {}, *acquired);
    if (result != vk::Result::eSuccess && result != vk::Result::eSuboptimalKHR) return std::nullopt;
    if (native.device.waitForFences(*acquired, true, kLongestWait) != vk::Result::eSuccess)
      throw Error("the window system does not give a picture back");
    return index;
  } catch (const vk::OutOfDateKHRError&) {
    return std::nullopt;
  }
}

void Presenter::Impl::copy(const RenderTarget::Impl& picture, vk::Image to) const {
  const auto change = [&](const vk::raii::CommandBuffer& commands, Layout from_layout, Layout to_layout) {
    const vk::ImageMemoryBarrier2 barrier{.srcStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                          .srcAccessMask = vk::AccessFlagBits2::eMemoryWrite,
                                          .dstStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                          .dstAccessMask = vk::AccessFlagBits2::eMemoryWrite,
                                          .oldLayout = from_layout,
                                          .newLayout = to_layout,
                                          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                          .image = to,
                                          .subresourceRange = {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}};
    record_layouts(commands, {barrier});
  };
  const auto corner = [](const vk::Extent2D& size) {
    return vk::Offset3D{static_cast<std::int32_t>(size.width), static_cast<std::int32_t>(size.height), 1};
  };
  run_now(native, "showing a picture", [&](const vk::raii::CommandBuffer& commands) {
    record_barrier_for_drawing(commands);
    change(commands, Layout::eUndefined, Layout::eTransferDstOptimal);
    record_with_color(commands, picture, [&](const vk::raii::Image& from) {
      commands.blitImage(*from, Layout::eTransferSrcOptimal, to, Layout::eTransferDstOptimal,
                         vk::ImageBlit{.srcSubresource = kWholeColor,
                                       .srcOffsets = {{vk::Offset3D{}, corner(picture.extent)}},
                                       .dstSubresource = kWholeColor,
                                       .dstOffsets = {{vk::Offset3D{}, corner(extent)}}},
                         vk::Filter::eLinear);
    });
    change(commands, Layout::eTransferDstOptimal, Layout::ePresentSrcKHR);
  });
}

bool Presenter::Impl::hand_over(std::uint32_t index) {
  try {
    // Without a semaphore: the copy has already been waited for.
    const vk::Result result =
        native.queue.presentKHR({.swapchainCount = 1, .pSwapchains = &*swapchain, .pImageIndices = &index});
    if (result == vk::Result::eSuboptimalKHR) swapchain = nullptr;  // shown, but made anew for the next one
    return true;
  } catch (const vk::OutOfDateKHRError&) {
    swapchain = nullptr;
    return false;
  }
}

Presenter::Presenter(Device& device, const SurfaceMaker& make_surface)
    : impl_(std::make_unique<Impl>(device.native())) {
  Device::Native& native = device.native();
  VkInstance instance = *native.instance.instance;
  const std::uint64_t made = make_surface(instance);
  if (made == 0) throw Error("the window has no surface that Vulkan can draw to");
  impl_->surface = vk::raii::SurfaceKHR(native.instance.instance, reinterpret_cast<VkSurfaceKHR>(made));
  with_surface(native, "preparing the window", [&] {
    if (!native.physical_device.getSurfaceSupportKHR(native.queue_family, *impl_->surface))
      throw Error("device " + native.info.name +
                  " cannot show pictures in this window; choose another with --device");
    const auto format = choose_format(native.physical_device.getSurfaceFormatsKHR(*impl_->surface));
    if (!format) throw Error("the window takes no pictures of 8 bits per channel");
    impl_->format = *format;
    impl_->acquired = {native.device, vk::FenceCreateInfo{}};
  });
}

Presenter::~Presenter() = default;

bool Presenter::has_pixels() const {
  return with_surface(impl_->native, "looking at the window", [&] {
    const auto size = impl_->native.physical_device.getSurfaceCapabilitiesKHR(*impl_->surface).currentExtent;
    return size.width != 0 && size.height != 0;
  });
}

bool Presenter::present(const RenderTarget& picture) {
  return with_surface(impl_->native, "showing a picture", [&] {
    const RenderTarget::Impl& images = picture.impl();
    const bool fits = *impl_->swapchain != vk::SwapchainKHR{} && impl_->extent == images.extent;
    if (!fits && !impl_->remake(images.extent)) return false;
    std::optional<std::uint32_t> index = impl_->acquire();
    if (!index) {
      if (!impl_->remake(images.extent)) return false;
      index = impl_->acquire();
    }
    if (!index) return false;
    impl_->copy(images, impl_->images[*index]);
    return impl_->hand_over(*index);
  });
}

}  // namespace scene_analyzer::gpu
