#include "gpu/reflection.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <spirv/unified1/spirv.hpp11>
#include <unordered_map>

#include "gpu/error.h"

namespace scene_analyzer::gpu {
namespace {

using Words = std::span<const std::uint32_t>;
using Id = std::uint32_t;
constexpr std::size_t kHeaderWords = 5;

struct Instruction {
  spv::Op op{};
  Words operands;  // without the first word
};

struct Member {
  std::string name;
  std::uint32_t offset = 0;
  std::uint32_t matrix_stride = 0;
};

struct Decorations {
  std::optional<std::uint32_t> set, binding, spec_id, array_stride;
  bool is_workgroup_size = false;
  bool is_buffer_block = false;
};

struct Extent {
  std::uint32_t size = 0;
  std::uint32_t alignment = 1;  // of the widest scalar inside
};

// One pass over the words collects what the questions below need.
class Module {
 public:
  Module(Words words, Words specialization) : specialization_(specialization) {
    if (words.size() < kHeaderWords || words[0] != spv::MagicNumber) throw Error("not a SPIR-V module");
    for (std::size_t at = kHeaderWords; at < words.size();) {
      const std::uint32_t length = words[at] >> 16;
      if (length == 0 || at + length > words.size()) throw Error("the SPIR-V module is cut short");
      const auto op = static_cast<spv::Op>(words[at] & 0xffffu);
      // Interesting things stand before the first function.
      if (op == spv::Op::OpFunction) break;
      read({op, words.subspan(at + 1, length - 1)});
      at += length;
    }
    if (entry_points_ != 1) throw Error("a kernel has exactly one compute entry point");
  }

  std::array<std::uint32_t, 3> local_size() const {
    if (workgroup_size_ != 0) return constants_of(operands(workgroup_size_));
    if (local_size_ids_) return {value(local_size_[0]), value(local_size_[1]), value(local_size_[2])};
    return local_size_;
  }
  void describe_variables(Reflection& result) const {
    for (const auto& [id, storage] : variables_) {
      switch (storage) {
        case spv::StorageClass::StorageBuffer:
          add_buffer(id, result);
          break;
        case spv::StorageClass::PushConstant:
          describe_push_constants(pointee(id), result);
          break;
        case spv::StorageClass::Uniform:
          if (!decorations(pointee(id)).is_buffer_block)
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

 private:
  void read(const Instruction& instruction);
  void define(Id id, const Instruction& instruction, const Words& parts);
  void read_decoration(const Words& operands);
  void read_member_decoration(const Words& operands);
  void read_entry_point(const Words& operands) {
    if (at(operands, 0) != static_cast<std::uint32_t>(spv::ExecutionModel::GLCompute))
      throw Error("not a compute shader");
    ++entry_points_;
  }
  void read_mode(const Words& operands, spv::ExecutionMode wanted, bool ids) {
    if (at(operands, 1) != static_cast<std::uint32_t>(wanted)) return;
    local_size_ = {at(operands, 2), at(operands, 3), at(operands, 4)};
    local_size_ids_ = ids;
  }

  static std::uint32_t at(const Words& operands, std::size_t index) {
    if (index >= operands.size()) throw Error("a SPIR-V instruction is cut short");
    return operands[index];
  }
  static std::string text(Words words) {
    const auto* begin = reinterpret_cast<const char*>(words.data());
    return {begin, ::strnlen(begin, words.size_bytes())};
  }
  const Instruction& definition(Id id) const {
    const auto found = definitions_.find(id);
    if (found == definitions_.end()) throw Error("the SPIR-V module uses an id it does not define");
    return found->second;
  }
  Words operands(Id id) const { return definition(id).operands; }
  const Decorations& decorations(Id id) const {
    static const Decorations kNone;
    const auto found = decorations_.find(id);
    return found == decorations_.end() ? kNone : found->second;
  }
  Id pointee(Id variable) const { return at(operands(at(operands(variable), 0)), 2); }

  // Operands of a constant: result type, result id, value.
  std::uint32_t value(Id id) const {
    const Instruction& constant = definition(id);
    const auto& spec_id = decorations(id).spec_id;
    if (constant.op == spv::Op::OpSpecConstant && spec_id && *spec_id < specialization_.size())
      return specialization_[*spec_id];
    if (constant.op != spv::Op::OpConstant && constant.op != spv::Op::OpSpecConstant)
      throw Error("a local size or array length that is computed from other constants is not understood");
    return at(constant.operands, 2);
  }
  std::array<std::uint32_t, 3> constants_of(const Words& composite) const {
    return {value(at(composite, 2)), value(at(composite, 3)), value(at(composite, 4))};
  }

  void add_buffer(Id id, Reflection& result) const;
  void describe_push_constants(Id type, Reflection& result) const;
  void add_members(Id type, std::uint32_t base, Reflection& result) const;
  Extent extent(Id type, std::uint32_t matrix_stride) const;
  Extent struct_extent(Id type) const;
  const Member& member(Id type, std::uint32_t index) const {
    static const Member kNone;
    const auto found = members_.find({type, index});
    return found == members_.end() ? kNone : found->second;
  }

  Words specialization_;
  std::unordered_map<Id, Instruction> definitions_;  // types, constants and variables
  std::unordered_map<Id, Decorations> decorations_;
  std::unordered_map<Id, std::string> names_;
  std::map<std::pair<Id, std::uint32_t>, Member> members_;
  std::vector<std::pair<Id, spv::StorageClass>> variables_;
  std::array<std::uint32_t, 3> local_size_{1, 1, 1};
  bool local_size_ids_ = false;
  Id workgroup_size_ = 0;
  int entry_points_ = 0;
};

void Module::read(const Instruction& instruction) {
  const Words& operands = instruction.operands;
  switch (instruction.op) {
    case spv::Op::OpEntryPoint:
      read_entry_point(operands);
      break;
    case spv::Op::OpExecutionMode:
      read_mode(operands, spv::ExecutionMode::LocalSize, false);
      break;
    case spv::Op::OpExecutionModeId:
      read_mode(operands, spv::ExecutionMode::LocalSizeId, true);
      break;
    case spv::Op::OpName:
      names_[at(operands, 0)] = text(operands.subspan(1));
      break;
    case spv::Op::OpMemberName:
      at(operands, 2);
      members_[{operands[0], operands[1]}].name = text(operands.subspan(2));
      break;
    case spv::Op::OpDecorate:
      read_decoration(operands);
      break;
    case spv::Op::OpMemberDecorate:
      read_member_decoration(operands);
      break;
    case spv::Op::OpVariable:
      define(at(operands, 1), instruction, {});
      variables_.emplace_back(operands[1], static_cast<spv::StorageClass>(at(operands, 2)));
      break;
    case spv::Op::OpConstant:
    case spv::Op::OpSpecConstant:
    case spv::Op::OpSpecConstantOp:
    case spv::Op::OpConstantComposite:
    case spv::Op::OpSpecConstantComposite:
      define(at(operands, 1), instruction, {});
      break;
    case spv::Op::OpTypeBool:
    case spv::Op::OpTypeInt:
    case spv::Op::OpTypeFloat:
    case spv::Op::OpTypePointer:
      define(at(operands, 0), instruction, {});
      break;
    case spv::Op::OpTypeVector:
    case spv::Op::OpTypeMatrix:
    case spv::Op::OpTypeArray:
    case spv::Op::OpTypeRuntimeArray:
      at(operands, 1);
      define(operands[0], instruction, operands.subspan(1, 1));
      break;
    case spv::Op::OpTypeStruct:
      define(at(operands, 0), instruction, operands.subspan(1));
      break;
    default:
      break;
  }
}

// Parts come before the whole and ids are defined once, so that no type contains itself.
void Module::define(Id id, const Instruction& instruction, const Words& parts) {
  for (const Id part : parts) definition(part);
  if (!definitions_.emplace(id, instruction).second) throw Error("the SPIR-V module defines an id twice");
}

void Module::read_decoration(const Words& operands) {
  Decorations& target = decorations_[at(operands, 0)];
  switch (static_cast<spv::Decoration>(at(operands, 1))) {
    case spv::Decoration::DescriptorSet:
      target.set = at(operands, 2);
      break;
    case spv::Decoration::Binding:
      target.binding = at(operands, 2);
      break;
    case spv::Decoration::SpecId:
      target.spec_id = at(operands, 2);
      break;
    case spv::Decoration::ArrayStride:
      target.array_stride = at(operands, 2);
      break;
    case spv::Decoration::BufferBlock:
      target.is_buffer_block = true;
      break;
    case spv::Decoration::BuiltIn:
      if (at(operands, 2) == static_cast<std::uint32_t>(spv::BuiltIn::WorkgroupSize))
        workgroup_size_ = operands[0];
      break;
    default:
      break;
  }
}

void Module::read_member_decoration(const Words& operands) {
  Member& target = members_[{at(operands, 0), at(operands, 1)}];
  switch (static_cast<spv::Decoration>(at(operands, 2))) {
    case spv::Decoration::Offset:
      target.offset = at(operands, 3);
      break;
    case spv::Decoration::MatrixStride:
      target.matrix_stride = at(operands, 3);
      break;
    default:
      break;
  }
}

void Module::add_buffer(Id id, Reflection& result) const {
  const Decorations& where = decorations(id);
  if (where.set.value_or(0) != 0) throw Error("a kernel's buffers are in descriptor set 0");
  if (definition(pointee(id)).op != spv::Op::OpTypeStruct)
    throw Error("arrays of storage buffers are not used in kernels");
  const auto name_of = [this](Id named) {
    const auto found = names_.find(named);
    return found == names_.end() ? std::string() : found->second;
  };
  std::string name = name_of(id);
  if (name.empty()) name = name_of(pointee(id));
  result.storage_buffers.push_back({where.binding.value_or(0), std::move(name)});
}

void Module::describe_push_constants(Id type, Reflection& result) const {
  add_members(type, 0, result);
  const Extent whole = struct_extent(type);
  result.push_constant_bytes = (whole.size + whole.alignment - 1) / whole.alignment * whole.alignment;
}

void Module::add_members(Id type, std::uint32_t base, Reflection& result) const {
  const Words fields = operands(type).subspan(1);
  for (std::uint32_t i = 0; i < fields.size(); ++i) {
    const Member& field = member(type, i);
    if (definition(fields[i]).op == spv::Op::OpTypeStruct)
      add_members(fields[i], base + field.offset, result);
    else
      result.push_constants.push_back(
          {field.name, base + field.offset, extent(fields[i], field.matrix_stride).size});
  }
}

Extent Module::struct_extent(Id type) const {
  const Words fields = operands(type).subspan(1);
  Extent whole;
  for (std::uint32_t i = 0; i < fields.size(); ++i) {
    const Member& field = member(type, i);
    const Extent part = extent(fields[i], field.matrix_stride);
    whole.size = std::max(whole.size, field.offset + part.size);
    whole.alignment = std::max(whole.alignment, part.alignment);
  }
  return whole;
}

Extent Module::extent(Id type, std::uint32_t matrix_stride) const {
  const Instruction& shape = definition(type);
  switch (shape.op) {
    case spv::Op::OpTypeInt:
    case spv::Op::OpTypeFloat:
      return {at(shape.operands, 1) / 8, at(shape.operands, 1) / 8};
    case spv::Op::OpTypeVector: {
      const Extent scalar = extent(at(shape.operands, 1), 0);
      return {scalar.size * at(shape.operands, 2), scalar.alignment};
    }
    case spv::Op::OpTypeMatrix: {
      const Extent column = extent(at(shape.operands, 1), 0);
      return {matrix_stride * at(shape.operands, 2), column.alignment};
    }
    case spv::Op::OpTypeArray: {
      const Extent element = extent(at(shape.operands, 1), matrix_stride);
      const std::uint32_t stride = decorations(type).array_stride.value_or(element.size);
      return {stride * value(at(shape.operands, 2)), element.alignment};
    }
    case spv::Op::OpTypeRuntimeArray:
      return {0, extent(at(shape.operands, 1), matrix_stride).alignment};
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

Reflection reflect(Words words, Words specialization) {
  const Module module(words, specialization);
  Reflection result;
  result.local_size = module.local_size();
  module.describe_variables(result);
  order_and_check(result);
  return result;
}

}  // namespace scene_analyzer::gpu
