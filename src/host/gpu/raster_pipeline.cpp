#include "gpu/raster_pipeline.h"

#include <array>
#include <vector>

#include "gpu/error.h"
#include "gpu/native.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::gpu {
namespace {

vk::Format format_of(VertexFormat format) {
  switch (format) {
    case VertexFormat::kFloat2:
      return vk::Format::eR32G32Sfloat;
    case VertexFormat::kFloat3:
      return vk::Format::eR32G32B32Sfloat;
    case VertexFormat::kUint1:
      return vk::Format::eR32Uint;
    case VertexFormat::kUnorm8x4:
      return vk::Format::eR8G8B8A8Unorm;
    case VertexFormat::kUnorm16x2:
      return vk::Format::eR16G16Unorm;
  }
  throw Error("a vertex format that no shader reads");
}

std::uint32_t stride_of(VertexFormat format) {
  if (format == VertexFormat::kFloat3) return 12;
  return format == VertexFormat::kFloat2 ? 8 : 4;
}

vk::raii::DescriptorSetLayout make_set_layout(const vk::raii::Device& device, const RasterShaders& shaders) {
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  if (shaders.reads_texture)
    bindings.push_back({.binding = 0,
                        .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                        .descriptorCount = 1,
                        .stageFlags = vk::ShaderStageFlagBits::eFragment});
  for (std::uint32_t i = 1; i <= shaders.buffer_count; ++i)
    bindings.push_back({.binding = i,
                        .descriptorType = vk::DescriptorType::eStorageBuffer,
                        .descriptorCount = 1,
                        .stageFlags = vk::ShaderStageFlagBits::eFragment});
  vk::DescriptorSetLayoutCreateInfo info{.flags = vk::DescriptorSetLayoutCreateFlagBits::ePushDescriptorKHR};
  info.setBindings(bindings);
  return {device, info};
}

vk::raii::PipelineLayout make_layout(const vk::raii::Device& device, vk::DescriptorSetLayout set_layout,
                                     std::uint32_t push_constant_bytes) {
  const vk::PushConstantRange range{.stageFlags = kDrawStages, .size = push_constant_bytes};
  return {device,
          {.setLayoutCount = 1,
           .pSetLayouts = &set_layout,
           .pushConstantRangeCount = push_constant_bytes == 0 ? 0u : 1u,
           .pPushConstantRanges = &range}};
}

struct VertexInputs {
  std::vector<vk::VertexInputBindingDescription> bindings;
  std::vector<vk::VertexInputAttributeDescription> attributes;

  explicit VertexInputs(std::span<const VertexFormat> formats) {
    for (std::uint32_t i = 0; i < formats.size(); ++i) {
      bindings.push_back({.binding = i, .stride = stride_of(formats[i])});
      attributes.push_back({.location = i, .binding = i, .format = format_of(formats[i])});
    }
  }
};

vk::PipelineColorBlendAttachmentState blending(bool translucent) {
  using Channel = vk::ColorComponentFlagBits;
  using Factor = vk::BlendFactor;
  return {.blendEnable = translucent,
          .srcColorBlendFactor = Factor::eSrcAlpha,
          .dstColorBlendFactor = Factor::eOneMinusSrcAlpha,
          .srcAlphaBlendFactor = Factor::eOne,
          .dstAlphaBlendFactor = Factor::eOneMinusSrcAlpha,
          .colorWriteMask = Channel::eR | Channel::eG | Channel::eB | Channel::eA};
}

vk::raii::Pipeline make_pipeline(const Device::Native& native, const vk::raii::PipelineLayout& layout,
                                 const RasterShaders& shaders) {
  const auto module = [&](std::span<const std::uint32_t> words) {
    return vk::raii::ShaderModule(native.device, {.codeSize = words.size_bytes(), .pCode = words.data()});
  };
  const vk::raii::ShaderModule vertex = module(shaders.vertex), fragment = module(shaders.fragment);
  const std::array stages{
      vk::PipelineShaderStageCreateInfo{
          .stage = vk::ShaderStageFlagBits::eVertex, .module = *vertex, .pName = "main"},
      vk::PipelineShaderStageCreateInfo{
          .stage = vk::ShaderStageFlagBits::eFragment, .module = *fragment, .pName = "main"}};
  const VertexInputs inputs(shaders.inputs);
  vk::PipelineVertexInputStateCreateInfo vertex_input;
  vertex_input.setVertexBindingDescriptions(inputs.bindings);
  vertex_input.setVertexAttributeDescriptions(inputs.attributes);
  const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = vk::PrimitiveTopology::eTriangleList};
  const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
  // Edges are drawn over their own triangles: a little nearer than these.
  const float nearer = shaders.state.reversed_depth ? 1.0F : -1.0F;
  const vk::PipelineRasterizationStateCreateInfo rasterization{
      .polygonMode = shaders.state.wireframe ? vk::PolygonMode::eLine : vk::PolygonMode::eFill,
      .depthBiasEnable = shaders.state.wireframe,
      .depthBiasConstantFactor = 32 * nearer,
      .depthBiasSlopeFactor = nearer,
      .lineWidth = 1};
  const vk::PipelineMultisampleStateCreateInfo samples{.rasterizationSamples =
                                                           sample_count(shaders.state.samples)};
  const vk::PipelineDepthStencilStateCreateInfo depth{
      .depthTestEnable = shaders.state.tests_depth,
      .depthWriteEnable = shaders.state.tests_depth && !shaders.state.translucent,
      .depthCompareOp = shaders.state.reversed_depth ? vk::CompareOp::eGreater : vk::CompareOp::eLess};
  const vk::PipelineColorBlendAttachmentState channels = blending(shaders.state.translucent);
  const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = 1, .pAttachments = &channels};
  const std::array dynamic_states{vk::DynamicState::eViewport, vk::DynamicState::eScissor,
                                  vk::DynamicState::eVertexInputBindingStride};
  vk::PipelineDynamicStateCreateInfo dynamic;
  dynamic.setDynamicStates(dynamic_states);
  const vk::PipelineRenderingCreateInfo targets{.colorAttachmentCount = 1,
                                                .pColorAttachmentFormats = &kColorFormat,
                                                .depthAttachmentFormat = kDepthFormat};
  return {native.device, native.pipeline_cache.handle(),
          vk::GraphicsPipelineCreateInfo{.pNext = &targets,
                                         .stageCount = stages.size(),
                                         .pStages = stages.data(),
                                         .pVertexInputState = &vertex_input,
                                         .pInputAssemblyState = &assembly,
                                         .pViewportState = &viewport,
                                         .pRasterizationState = &rasterization,
                                         .pMultisampleState = &samples,
                                         .pDepthStencilState = &depth,
                                         .pColorBlendState = &blend,
                                         .pDynamicState = &dynamic,
                                         .layout = *layout}};
}

}  // namespace

RasterPipeline::RasterPipeline() = default;
RasterPipeline::~RasterPipeline() = default;
RasterPipeline::RasterPipeline(RasterPipeline&&) noexcept = default;
RasterPipeline& RasterPipeline::operator=(RasterPipeline&&) noexcept = default;

RasterPipeline Device::make_raster_pipeline(const std::string& name, const RasterShaders& shaders) {
  const std::string what = "raster pipeline '" + name + "'";
  if (!native_->info.can_draw) throw Error(what + ": device " + native_->info.name + " cannot draw");
  if (shaders.state.wireframe && !native_->info.draws_wireframes)
    throw Error(what + ": device " + native_->info.name + " cannot draw wireframes (fillModeNonSolid)");
  if (shaders.push_constant_bytes > native_->limits.maxPushConstantsSize)
    throw Error(what + ": " + std::to_string(shaders.push_constant_bytes) +
                " bytes of parameters, the device takes " +
                std::to_string(native_->limits.maxPushConstantsSize));
  RasterPipeline pipeline;
  pipeline.impl_ = std::make_unique<RasterPipeline::Impl>();
  RasterPipeline::Impl& impl = *pipeline.impl_;
  impl.name = name;
  impl.push_constant_bytes = shaders.push_constant_bytes;
  impl.reads_texture = shaders.reads_texture;
  impl.buffer_count = shaders.buffer_count;
  impl.samples = shaders.state.samples;
  for (const VertexFormat format : shaders.inputs) impl.strides.push_back(stride_of(format));
  translated("making " + what, [&] {
    impl.set_layout = make_set_layout(native_->device, shaders);
    impl.layout = make_layout(native_->device, *impl.set_layout, impl.push_constant_bytes);
    impl.pipeline = make_pipeline(*native_, impl.layout, shaders);
  });
  native_->set_name(vk::ObjectType::ePipeline,
                    reinterpret_cast<std::uint64_t>(static_cast<VkPipeline>(*impl.pipeline)), name);
  return pipeline;
}

}  // namespace scene_analyzer::gpu
