#include "gpu/raster_pipeline.h"

#include <array>
#include <vector>

#include "gpu/error.h"
#include "gpu/native.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::gpu {
namespace {

struct Layout {
  vk::Format format;
  std::uint32_t stride;
};

Layout layout_of(VertexFormat format) {
  switch (format) {
    case VertexFormat::kFloat3:
      return {vk::Format::eR32G32B32Sfloat, 12};
  }
  throw Error("a vertex format that no shader reads");
}

vk::raii::PipelineLayout make_layout(const vk::raii::Device& device, std::uint32_t push_constant_bytes) {
  const vk::PushConstantRange range{.stageFlags = kDrawStages, .size = push_constant_bytes};
  return {device,
          {.pushConstantRangeCount = push_constant_bytes == 0 ? 0u : 1u, .pPushConstantRanges = &range}};
}

struct VertexInputs {
  std::vector<vk::VertexInputBindingDescription> bindings;
  std::vector<vk::VertexInputAttributeDescription> attributes;

  explicit VertexInputs(std::span<const VertexFormat> formats) {
    for (std::uint32_t i = 0; i < formats.size(); ++i) {
      const Layout layout = layout_of(formats[i]);
      bindings.push_back({.binding = i, .stride = layout.stride});
      attributes.push_back({.location = i, .binding = i, .format = layout.format});
    }
  }
};

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
  const vk::PipelineRasterizationStateCreateInfo rasterization{.lineWidth = 1};
  const vk::PipelineMultisampleStateCreateInfo samples{.rasterizationSamples = vk::SampleCountFlagBits::e1};
  const vk::PipelineDepthStencilStateCreateInfo depth{
      .depthTestEnable = true, .depthWriteEnable = true, .depthCompareOp = vk::CompareOp::eLess};
  using Channel = vk::ColorComponentFlagBits;
  const vk::PipelineColorBlendAttachmentState channels{.colorWriteMask = Channel::eR | Channel::eG |
                                                                         Channel::eB | Channel::eA};
  const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = 1, .pAttachments = &channels};
  const std::array dynamic_states{vk::DynamicState::eViewport, vk::DynamicState::eScissor};
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
  if (shaders.push_constant_bytes > native_->limits.maxPushConstantsSize)
    throw Error(what + ": " + std::to_string(shaders.push_constant_bytes) +
                " bytes of parameters, the device takes " +
                std::to_string(native_->limits.maxPushConstantsSize));
  RasterPipeline pipeline;
  pipeline.impl_ = std::make_unique<RasterPipeline::Impl>();
  RasterPipeline::Impl& impl = *pipeline.impl_;
  impl.name = name;
  impl.input_count = static_cast<std::uint32_t>(shaders.inputs.size());
  impl.push_constant_bytes = shaders.push_constant_bytes;
  translated("making " + what, [&] {
    impl.layout = make_layout(native_->device, impl.push_constant_bytes);
    impl.pipeline = make_pipeline(*native_, impl.layout, shaders);
  });
  native_->set_name(vk::ObjectType::ePipeline,
                    reinterpret_cast<std::uint64_t>(static_cast<VkPipeline>(*impl.pipeline)), name);
  return pipeline;
}

}  // namespace scene_analyzer::gpu
