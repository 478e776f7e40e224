#include "gpu/reflection.h"

#include <algorithm>

#include "gpu/error.h"
#include "gpu/spirv_module.h"

namespace scene_analyzer::gpu {
namespace {

using Id = SpirvModule::Id;

struct Extent {
  std::uint32_t size = 0;
  std::uint32_t alignment = 1;  // of the widest scalar inside
};

// What the module's variables look like from the host.
class Shape {
 public:
  explicit Shape(const SpirvModule& module) : module_(module) {}
  void describe_variables(Reflection& result) const;

 private:
  void add_buffer(Id id, Reflection& result) const;
  void describe_push_constants(Id type, Reflection& result) const;
  void add_members(Id type, std::uint32_t base, Reflection& result) const;
  Extent extent(Id type, std::uint32_t matrix_stride) const;
  Extent struct_extent(Id type) const;
  SpirvModule::Words fields_of(Id type) const;

  const SpirvModule& module_;
};

void Shape::describe_variables(Reflection& result) const {
  for (const auto& [id, storage] : module_.variables()) {
    switch (storage) {
      case spv::StorageClass::StorageBuffer:
        add_buffer(id, result);
        break;
      case spv::StorageClass::PushConstant:
        describe_push_constants(module_.pointee(id), result);
        break;
      case spv::StorageClass::Uniform:  // where storage buffers were before SPIR-V 1.3
        if (!module_.decorations(module_.pointee(id)).is_buffer_block)
          throw Error("uniform buffers are not used in kernels");
        add_buffer(id, result);
        break;
      case spv::StorageClass::UniformConstant:
        throw Error("images and samplers are not used in kernels");
      default:
        break;
    }
  }
}

SpirvModule::Words Shape::fields_of(Id type) const {
  const auto& shape = module_.definition(type);
  if (shape.op != spv::Op::OpTypeStruct) throw Error("a block is not a struct");
  return shape.from(1);
}

void Shape::add_buffer(Id id, Reflection& result) const {
  const auto& where = module_.decorations(id);
  if (where.set.value_or(0) != 0) throw Error("a kernel's buffers are in descriptor set 0");
  if (module_.definition(module_.pointee(id)).op != spv::Op::OpTypeStruct)
    throw Error("arrays of storage buffers are not used in kernels");
  std::string name = module_.name(id);
  if (name.empty()) name = module_.name(module_.pointee(id));
  result.storage_buffers.push_back({where.binding.value_or(0), std::move(name)});
}

void Shape::describe_push_constants(Id type, Reflection& result) const {
  add_members(type, 0, result);
  const Extent whole = struct_extent(type);
  result.push_constant_bytes = (whole.size + whole.alignment - 1) / whole.alignment * whole.alignment;
}

void Shape::add_members(Id type, std::uint32_t base, Reflection& result) const {
  const auto fields = fields_of(type);
  for (std::uint32_t i = 0; i < fields.size(); ++i) {
    const SpirvModule::Member& field = module_.member(type, i);
    if (module_.definition(fields[i]).op == spv::Op::OpTypeStruct)
      add_members(fields[i], base + field.offset, result);
    else
      result.push_constants.push_back(
          {field.name, base + field.offset, extent(fields[i], field.matrix_stride).size});
  }
}

Extent Shape::struct_extent(Id type) const {
  const auto fields = fields_of(type);
  Extent whole;
  for (std::uint32_t i = 0; i < fields.size(); ++i) {
    const SpirvModule::Member& field = module_.member(type, i);
    const Extent part = extent(fields[i], field.matrix_stride);
    whole.size = std::max(whole.size, field.offset + part.size);
    whole.alignment = std::max(whole.alignment, part.alignment);
  }
  return whole;
}

Extent Shape::extent(Id type, std::uint32_t matrix_stride) const {
  const auto& shape = module_.definition(type);
  switch (shape.op) {
    case spv::Op::OpTypeInt:
    case spv::Op::OpTypeFloat:
      return {shape[1] / 8, shape[1] / 8};
    case spv::Op::OpTypeVector: {
      const Extent scalar = extent(shape[1], 0);
      return {scalar.size * shape[2], scalar.alignment};
    }
    case spv::Op::OpTypeMatrix: {
      const Extent column = extent(shape[1], 0);
      return {matrix_stride * shape[2], column.alignment};
    }
    case spv::Op::OpTypeArray: {
      const Extent element = extent(shape[1], matrix_stride);
      const std::uint32_t stride = module_.decorations(type).array_stride.value_or(element.size);
      return {stride * module_.value(shape[2]), element.alignment};
    }
    case spv::Op::OpTypeRuntimeArray:
      return {0, extent(shape[1], matrix_stride).alignment};
    case spv::Op::OpTypeStruct:
      return struct_extent(type);
    default:
      throw Error("a block member has a type that kernels do not use");
  }
}

void order_and_check(Reflection& result) {
  auto& buffers = result.storage_buffers;
  std::stable_sort(buffers.begin(), buffers.end(),
                   [](const auto& left, const auto& right) { return left.binding < right.binding; });
  for (const StorageBinding& buffer : buffers) {
    if (buffer.binding > result.buffer_count)
      throw Error("no storage buffer has binding " + std::to_string(result.buffer_count) + ", but one has " +
                  std::to_string(buffer.binding) + ": bindings are numbered without gaps");
    result.buffer_count = buffer.binding + 1;
  }
}

}  // namespace

Reflection reflect(std::span<const std::uint32_t> words, std::span<const std::uint32_t> specialization) {
  const SpirvModule module(words, specialization);
  Reflection result;
  result.local_size = module.local_size();
  Shape(module).describe_variables(result);
  order_and_check(result);
  return result;
}

}  // namespace scene_analyzer::gpu
