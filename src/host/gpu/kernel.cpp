#include "gpu/kernel.h"

#include <numeric>

#include "gpu/error.h"
#include "gpu/native.h"
#include "gpu/reflection.h"
#include "gpu/vulkan_errors.h"

namespace scene_analyzer::gpu {
namespace {

Reflection reflect_named(const std::string& name, std::span<const std::uint32_t> words,
                         std::span<const std::uint32_t> specialization) {
  try {
    return reflect(words, specialization);
  } catch (const Error& error) {
    throw Error("kernel '" + name + "': " + error.what());
  }
}

void check_limits(const std::string& name, const Reflection& shader, const vk::PhysicalDeviceLimits& limits) {
  const auto fail = [&](const std::string& what) { throw Error("kernel '" + name + "': " + what); };
  if (shader.local_size[1] != 1 || shader.local_size[2] != 1) fail("workgroups are one-dimensional");
  const std::uint32_t most_threads =
      std::min(limits.maxComputeWorkGroupSize[0], limits.maxComputeWorkGroupInvocations);
  if (shader.local_size[0] == 0 || shader.local_size[0] > most_threads)
    fail("a workgroup has " + std::to_string(shader.local_size[0]) + " threads, the device takes 1 to " +
         std::to_string(most_threads));
  if (shader.push_constant_bytes > limits.maxPushConstantsSize)
    fail(std::to_string(shader.push_constant_bytes) + " bytes of parameters, the device takes " +
         std::to_string(limits.maxPushConstantsSize));
  if (shader.buffer_count > limits.maxPerStageDescriptorStorageBuffers)
    fail(std::to_string(shader.buffer_count) + " buffers, the device takes " +
         std::to_string(limits.maxPerStageDescriptorStorageBuffers));
}

vk::raii::DescriptorSetLayout make_set_layout(const vk::raii::Device& device, std::uint32_t buffer_count) {
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (std::uint32_t i = 0; i < buffer_count; ++i)
    bindings.push_back({.binding = i,
                        .descriptorType = vk::DescriptorType::eStorageBuffer,
                        .descriptorCount = 1,
                        .stageFlags = vk::ShaderStageFlagBits::eCompute});
  return {device,
          {.flags = vk::DescriptorSetLayoutCreateFlagBits::ePushDescriptorKHR,
           .bindingCount = buffer_count,
           .pBindings = bindings.data()}};
}

vk::raii::PipelineLayout make_layout(const vk::raii::Device& device, const vk::raii::DescriptorSetLayout& set,
                                     std::uint32_t push_constant_bytes) {
  const vk::PushConstantRange range{.stageFlags = vk::ShaderStageFlagBits::eCompute,
                                    .size = push_constant_bytes};
  return {device,
          {.setLayoutCount = 1,
           .pSetLayouts = &*set,
           .pushConstantRangeCount = push_constant_bytes == 0 ? 0u : 1u,
           .pPushConstantRanges = &range}};
}

vk::raii::Pipeline make_pipeline(const Device::Native& native, const vk::raii::PipelineLayout& layout,
                                 std::span<const std::uint32_t> words,
                                 std::span<const std::uint32_t> specialization) {
  const vk::raii::ShaderModule module(native.device, {.codeSize = words.size_bytes(), .pCode = words.data()});
  std::vector<vk::SpecializationMapEntry> entries;
  for (std::uint32_t i = 0; i < specialization.size(); ++i)
    entries.push_back({.constantID = i, .offset = i * 4, .size = 4});
  const vk::SpecializationInfo values{.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
                                      .pMapEntries = entries.data(),
                                      .dataSize = specialization.size_bytes(),
                                      .pData = specialization.data()};
  return {native.device, native.pipeline_cache.handle(),
          vk::ComputePipelineCreateInfo{.stage = {.stage = vk::ShaderStageFlagBits::eCompute,
                                                  .module = *module,
                                                  .pName = "main",
                                                  .pSpecializationInfo = &values},
                                        .layout = *layout}};
}

}  // namespace

Kernel::Kernel() = default;
Kernel::~Kernel() = default;
Kernel::Kernel(Kernel&&) noexcept = default;
Kernel& Kernel::operator=(Kernel&&) noexcept = default;

const std::string& Kernel::name() const {
  return impl_->name;
}
std::uint32_t Kernel::local_size() const {
  return impl_->local_size;
}
std::uint32_t Kernel::buffer_count() const {
  return impl_->buffer_count;
}
std::uint32_t Kernel::push_constant_bytes() const {
  return impl_->push_constant_bytes;
}

Kernel Device::make_kernel(const std::string& name, std::span<const std::uint32_t> words,
                           std::span<const std::uint32_t> specialization) {
  const Reflection shader = reflect_named(name, words, specialization);
  check_limits(name, shader, native_->limits);
  Kernel kernel;
  kernel.impl_ = std::make_unique<Kernel::Impl>();
  Kernel::Impl& impl = *kernel.impl_;
  impl.name = name;
  impl.local_size = shader.local_size[0];
  impl.buffer_count = shader.buffer_count;
  impl.push_constant_bytes = shader.push_constant_bytes;
  translated("making kernel '" + name + "'", [&] {
    impl.set_layout = make_set_layout(native_->device, impl.buffer_count);
    impl.layout = make_layout(native_->device, impl.set_layout, impl.push_constant_bytes);
    impl.pipeline = make_pipeline(*native_, impl.layout, words, specialization);
  });
  native_->set_name(vk::ObjectType::ePipeline,
                    reinterpret_cast<std::uint64_t>(static_cast<VkPipeline>(*impl.pipeline)), name);
  return kernel;
}

}  // namespace scene_analyzer::gpu
