// The Recorder's draws.
#include "gpu/error.h"
#include "gpu/native.h"
#include "gpu/recorder.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::gpu {
namespace {

using Layout = vk::ImageLayout;
using Aspect = vk::ImageAspectFlagBits;

void check(const std::string& where, const RasterPipeline::Impl& pipeline, std::uint32_t params_bytes,
           const Recorder::Draw& draw) {
  if (params_bytes != pipeline.push_constant_bytes)
    wrong(where, "got " + std::to_string(params_bytes) + " bytes of parameters, the shaders have " +
                     std::to_string(pipeline.push_constant_bytes));
  if (draw.inputs.size() != pipeline.strides.size())
    wrong(where, "got " + std::to_string(draw.inputs.size()) + " buffers, the vertex shader has " +
                     std::to_string(pipeline.strides.size()));
  if (draw.indices != nullptr &&
      (std::uint64_t{draw.first_index} + draw.index_count) * sizeof(std::uint32_t) > draw.indices->bytes())
    wrong(where, "indices " + std::to_string(draw.first_index) + " to " +
                     std::to_string(std::uint64_t{draw.first_index} + draw.index_count) +
                     " are not in the index buffer");
  for (const BufferRange& input : draw.inputs)
    if (input.buffer == nullptr || input.offset_bytes >= input.buffer->bytes())
      wrong(where, "a vertex buffer is empty");
  if ((draw.texture != nullptr) != pipeline.reads_texture)
    wrong(where, draw.texture ? "the fragment shader reads no texture" : "the texture is missing");
  if (draw.buffers.size() != pipeline.buffer_count)
    wrong(where, "got " + std::to_string(draw.buffers.size()) + " buffers, the fragment shader has " +
                     std::to_string(pipeline.buffer_count));
}

// The fragment shader's texture and buffers.
void record_descriptors(const Device::Native& draw_device, const vk::raii::CommandBuffer& commands,
                        const RasterPipeline::Impl& pipeline, const Recorder::Draw& draw) {
  vk::DescriptorImageInfo image;
  std::vector<vk::DescriptorBufferInfo> buffers;
  std::vector<vk::WriteDescriptorSet> writes;
  if (draw.texture != nullptr) {
    const Texture::Impl& texture = draw.texture->impl();
    image = {.sampler = *draw_device.sampler,
             .imageView = *texture.image.view,
             .imageLayout = Layout::eShaderReadOnlyOptimal};
    writes.push_back({.dstBinding = 0,
                      .descriptorCount = 1,
                      .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                      .pImageInfo = &image});
  }
  buffers.reserve(draw.buffers.size());
  for (const BufferRange& range : draw.buffers) {
    buffers.push_back({.buffer = *range.buffer->impl().buffer,
                       .offset = range.offset_bytes,
                       .range = range.size_bytes == 0 ? VK_WHOLE_SIZE : range.size_bytes});
    writes.push_back({.dstBinding = static_cast<std::uint32_t>(buffers.size()),
                      .descriptorCount = 1,
                      .descriptorType = vk::DescriptorType::eStorageBuffer,
                      .pBufferInfo = &buffers.back()});
  }
  if (!writes.empty())
    commands.pushDescriptorSetKHR(vk::PipelineBindPoint::eGraphics, *pipeline.layout, 0, writes);
}

void record_vertex_inputs(const vk::raii::CommandBuffer& commands, const RasterPipeline::Impl& pipeline,
                          const Recorder::Draw& draw) {
  for (std::uint32_t i = 0; i < draw.inputs.size(); ++i) {
    const bool single = (draw.single_inputs >> i & 1) != 0;
    const vk::DeviceSize stride = single ? 0 : pipeline.strides[i];
    commands.bindVertexBuffers2(i, *draw.inputs[i].buffer->impl().buffer, draw.inputs[i].offset_bytes,
                                nullptr, stride);
  }
}

void record_begin_rendering(const vk::raii::CommandBuffer& commands, const RenderTarget::Impl& images,
                            vk::AttachmentLoadOp load, const vk::ClearValue& color_value,
                            float farthest_depth) {
  const vk::ClearValue farthest{.depthStencil = {.depth = farthest_depth}};
  const vk::RenderingAttachmentInfo color{.imageView = *images.color.view,
                                          .imageLayout = Layout::eColorAttachmentOptimal,
                                          .loadOp = load,
                                          .storeOp = vk::AttachmentStoreOp::eStore,
                                          .clearValue = color_value};
  const vk::RenderingAttachmentInfo depth{.imageView = *images.depth.view,
                                          .imageLayout = Layout::eDepthStencilAttachmentOptimal,
                                          .loadOp = load,
                                          .storeOp = vk::AttachmentStoreOp::eStore,
                                          .clearValue = farthest};
  const vk::Rect2D whole{.extent = images.extent};
  commands.beginRendering({.renderArea = whole,
                           .layerCount = 1,
                           .colorAttachmentCount = 1,
                           .pColorAttachments = &color,
                           .pDepthAttachment = &depth});
  commands.setViewport(0, vk::Viewport{.width = static_cast<float>(images.extent.width),
                                       .height = static_cast<float>(images.extent.height),
                                       .maxDepth = 1});
  commands.setScissor(0, whole);
}

}  // namespace

void record_with_color(const vk::raii::CommandBuffer& commands, const RenderTarget::Impl& images,
                       const std::function<void(const vk::raii::Image&)>& use) {
  const auto change = [&](const Image& image, Layout old_layout, Layout new_layout) {
    record_layouts(commands, {change_layout(image, Aspect::eColor, old_layout, new_layout)});
  };
  change(images.color, Layout::eColorAttachmentOptimal, Layout::eTransferSrcOptimal);
  if (images.samples > 1) {
    change(images.resolved, Layout::eUndefined, Layout::eTransferDstOptimal);
    commands.resolveImage(*images.color.image, Layout::eTransferSrcOptimal, *images.resolved.image,
                          Layout::eTransferDstOptimal,
                          vk::ImageResolve{.srcSubresource = kWholeColor,
                                           .dstSubresource = kWholeColor,
                                           .extent = {images.extent.width, images.extent.height, 1}});
    change(images.resolved, Layout::eTransferDstOptimal, Layout::eTransferSrcOptimal);
  }
  use(images.samples > 1 ? images.resolved.image : images.color.image);
  change(images.color, Layout::eTransferSrcOptimal, Layout::eColorAttachmentOptimal);
}

void Recorder::clear(const RenderTarget& target, const std::array<float, 4>& color, float depth) {
  const vk::raii::CommandBuffer& commands = impl_->next_step();
  const RenderTarget::Impl& images = target.impl();
  // Whatever the images hold and however it lies there, it may be lost.
  record_layouts(commands, {change_layout(images.color, Aspect::eColor, Layout::eUndefined,
                                          Layout::eColorAttachmentOptimal),
                            change_layout(images.depth, Aspect::eDepth, Layout::eUndefined,
                                          Layout::eDepthStencilAttachmentOptimal)});
  record_begin_rendering(commands, images, vk::AttachmentLoadOp::eClear,
                         vk::ClearValue{.color = {.float32 = color}}, depth);
  commands.endRendering();
  impl_->drawn = true;
}

void Recorder::begin_rendering(const RenderTarget& target) {
  const vk::raii::CommandBuffer& commands = impl_->next_step();
  record_barrier_for_drawing(commands);
  if (impl_->stopwatch) {
    // Around the rendering, with barriers in between: lavapipe draws tile by tile, and a timestamp that is
    // not kept apart becomes a part of every tile, of which the last one counts.
    translated("recording a timestamp", [&] { impl_->stopwatch->start(commands, target.impl().name); });
    record_barrier_for_drawing(commands);
  }
  record_begin_rendering(commands, target.impl(), vk::AttachmentLoadOp::eLoad, vk::ClearValue{.color = {}},
                         0);
  impl_->rendering = &target.impl();
  impl_->clipped = false;
  impl_->drawn = true;
}

void Recorder::end_rendering() {
  if (!std::exchange(impl_->rendering, nullptr)) wrong("recorder", "begin_rendering() was not called");
  impl_->commands.endRendering();
  if (!impl_->stopwatch) return;
  record_barrier_for_drawing(impl_->commands);
  impl_->stopwatch->stop(impl_->commands);
}

void Recorder::draw_bytes(const RasterPipeline& pipeline, const void* params, std::uint32_t params_bytes,
                          const Draw& draw) {
  const RasterPipeline::Impl& raster = pipeline.impl();
  const std::string where = "raster pipeline '" + raster.name + "'";
  check(where, raster, params_bytes, draw);
  if (!impl_->rendering) wrong(where, "begin_rendering() was not called");
  if (impl_->rendering->samples != raster.samples)
    wrong(where, "draws " + std::to_string(raster.samples) + " samples per pixel, picture '" +
                     impl_->rendering->name + "' has " + std::to_string(impl_->rendering->samples));
  const vk::raii::CommandBuffer& commands = impl_->commands;
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *raster.pipeline);
  if (params_bytes != 0)
    commands.pushConstants<std::byte>(*raster.layout, kDrawStages, 0,
                                      {params_bytes, static_cast<const std::byte*>(params)});
  if (draw.clip || impl_->clipped) {
    const vk::Extent2D& extent = impl_->rendering->extent;
    const auto [left, top, width, height] =
        draw.clip.value_or(std::array{0u, 0u, extent.width, extent.height});
    commands.setScissor(
        0, vk::Rect2D{{static_cast<std::int32_t>(left), static_cast<std::int32_t>(top)}, {width, height}});
    impl_->clipped = draw.clip.has_value();
  }
  record_vertex_inputs(commands, raster, draw);
  record_descriptors(impl_->device.native(), commands, raster, draw);
  if (draw.indices != nullptr)
    commands.bindIndexBuffer(*draw.indices->impl().buffer, 0, vk::IndexType::eUint32);
  translated("recording a draw", [&] {
    if (impl_->counters) impl_->counters->start(commands);
  });
  if (draw.indices != nullptr)
    commands.drawIndexed(draw.index_count, 1, draw.first_index, static_cast<std::int32_t>(draw.first_vertex),
                         0);
  else
    commands.draw(draw.index_count, 1, draw.first_vertex, 0);
  if (impl_->counters) impl_->counters->stop(commands);
}

void Recorder::copy_color(const RenderTarget& from, const Buffer& to, std::uint64_t offset) {
  const RenderTarget::Impl& images = from.impl();
  if (offset % 4 != 0 || offset > to.bytes() || from.color_bytes() > to.bytes() - offset)
    wrong("copy_color", "buffer '" + to.name() + "' of " + std::to_string(to.bytes()) +
                            " bytes has no room for picture '" + images.name + "' at " +
                            std::to_string(offset));
  const vk::raii::CommandBuffer& commands = impl_->next_step();
  record_with_color(commands, images, [&](const vk::raii::Image& source) {
    commands.copyImageToBuffer(
        *source, Layout::eTransferSrcOptimal, *to.impl().buffer,
        vk::BufferImageCopy{.bufferOffset = offset,
                            .imageSubresource = kWholeColor,
                            .imageExtent = {images.extent.width, images.extent.height, 1}});
  });
}

void Recorder::count_invocations() {
  const Device::Native& native = impl_->device.native();
  if (native.info.counts_invocations && !impl_->counters) impl_->counters.emplace(native.device);
}

const std::vector<Recorder::DrawCounts>& Recorder::draw_counts() const {
  return impl_->draw_counts;
}

}  // namespace scene_analyzer::gpu
