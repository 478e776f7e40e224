#include "gpu/spirv_module.h"

#include <cstring>

#include "gpu/error.h"

namespace scene_analyzer::gpu {
namespace {

constexpr std::size_t kHeaderWords = 5;

std::string text(SpirvModule::Words words) {
  const auto* begin = reinterpret_cast<const char*>(words.data());
  return {begin, ::strnlen(begin, words.size_bytes())};
}

}  // namespace

std::uint32_t SpirvModule::Instruction::operator[](std::size_t index) const {
  if (index >= operands.size()) throw Error("a SPIR-V instruction is cut short");
  return operands[index];
}

SpirvModule::Words SpirvModule::Instruction::from(std::size_t index) const {
  if (index > operands.size()) throw Error("a SPIR-V instruction is cut short");
  return operands.subspan(index);
}

SpirvModule::SpirvModule(Words words, Words specialization) : specialization_(specialization) {
  if (words.size() < kHeaderWords || words[0] != spv::MagicNumber) throw Error("not a SPIR-V module");
  for (std::size_t at = kHeaderWords; at < words.size();) {
    const std::uint32_t length = words[at] >> 16;
    if (length == 0 || at + length > words.size()) throw Error("the SPIR-V module is cut short");
    const auto op = static_cast<spv::Op>(words[at] & 0xffffu);
    if (op == spv::Op::OpFunction) break;  // all declarations stand before the first function
    read({op, words.subspan(at + 1, length - 1)});
    at += length;
  }
  if (entry_points_ != 1) throw Error("a kernel has exactly one compute entry point");
}

void SpirvModule::read(const Instruction& instruction) {
  switch (instruction.op) {
    case spv::Op::OpEntryPoint:
      read_entry_point(instruction);
      break;
    case spv::Op::OpExecutionMode:
    case spv::Op::OpExecutionModeId:
      read_mode(instruction);
      break;
    case spv::Op::OpName:
      names_[instruction[0]] = text(instruction.from(1));
      break;
    case spv::Op::OpMemberName:
      members_[{instruction[0], instruction[1]}].name = text(instruction.from(2));
      break;
    case spv::Op::OpDecorate:
      read_decoration(instruction);
      break;
    case spv::Op::OpMemberDecorate:
      read_member_decoration(instruction);
      break;
    default:
      read_declaration(instruction);
      break;
  }
}

void SpirvModule::read_declaration(const Instruction& instruction) {
  switch (instruction.op) {
    case spv::Op::OpVariable:
      define(instruction[1], instruction, {});
      variables_.push_back({instruction[1], static_cast<spv::StorageClass>(instruction[2])});
      break;
    case spv::Op::OpConstant:
    case spv::Op::OpSpecConstant:
    case spv::Op::OpSpecConstantOp:
    case spv::Op::OpConstantComposite:
    case spv::Op::OpSpecConstantComposite:
      define(instruction[1], instruction, {});
      break;
    case spv::Op::OpTypeBool:
    case spv::Op::OpTypeInt:
    case spv::Op::OpTypeFloat:
    case spv::Op::OpTypePointer:
      define(instruction[0], instruction, {});
      break;
    case spv::Op::OpTypeVector:
    case spv::Op::OpTypeMatrix:
    case spv::Op::OpTypeArray:
    case spv::Op::OpTypeRuntimeArray:
      instruction[1];  // the part: element, column or component type
      define(instruction[0], instruction, instruction.from(1).first(1));
      break;
    case spv::Op::OpTypeStruct:
      define(instruction[0], instruction, instruction.from(1));
      break;
    default:
      break;
  }
}

void SpirvModule::read_entry_point(const Instruction& instruction) {
  if (instruction[0] != static_cast<std::uint32_t>(spv::ExecutionModel::GLCompute))
    throw Error("not a compute shader");
  ++entry_points_;
}

// Operands: entry point, mode, three numbers or ids.
void SpirvModule::read_mode(const Instruction& instruction) {
  const auto mode = static_cast<spv::ExecutionMode>(instruction[1]);
  if (mode != spv::ExecutionMode::LocalSize && mode != spv::ExecutionMode::LocalSizeId) return;
  local_size_ = {instruction[2], instruction[3], instruction[4]};
  local_size_is_ids_ = mode == spv::ExecutionMode::LocalSizeId;
}

// Parts come before the whole and ids are defined once, so that no type contains itself.
void SpirvModule::define(Id id, const Instruction& instruction, const Words& parts) {
  for (const Id part : parts) definition(part);
  if (!definitions_.emplace(id, instruction).second) throw Error("the SPIR-V module defines an id twice");
}

void SpirvModule::read_decoration(const Instruction& instruction) {
  Decorations& target = decorations_[instruction[0]];
  switch (static_cast<spv::Decoration>(instruction[1])) {
    case spv::Decoration::DescriptorSet:
      target.set = instruction[2];
      break;
    case spv::Decoration::Binding:
      target.binding = instruction[2];
      break;
    case spv::Decoration::SpecId:
      target.spec_id = instruction[2];
      break;
    case spv::Decoration::ArrayStride:
      target.array_stride = instruction[2];
      break;
    case spv::Decoration::BufferBlock:
      target.is_buffer_block = true;
      break;
    case spv::Decoration::BuiltIn:
      if (instruction[2] == static_cast<std::uint32_t>(spv::BuiltIn::WorkgroupSize))
        workgroup_size_ = instruction[0];
      break;
    default:
      break;
  }
}

void SpirvModule::read_member_decoration(const Instruction& instruction) {
  Member& target = members_[{instruction[0], instruction[1]}];
  switch (static_cast<spv::Decoration>(instruction[2])) {
    case spv::Decoration::Offset:
      target.offset = instruction[3];
      break;
    case spv::Decoration::MatrixStride:
      target.matrix_stride = instruction[3];
      break;
    default:
      break;
  }
}

std::array<std::uint32_t, 3> SpirvModule::local_size() const {
  std::array<std::uint32_t, 3> ids = local_size_;
  if (workgroup_size_) {
    const Instruction& composite = definition(*workgroup_size_);
    ids = {composite[2], composite[3], composite[4]};
  } else if (!local_size_is_ids_) {
    return local_size_;
  }
  return {value(ids[0]), value(ids[1]), value(ids[2])};
}

const SpirvModule::Instruction& SpirvModule::definition(Id id) const {
  const auto found = definitions_.find(id);
  if (found == definitions_.end()) throw Error("the SPIR-V module uses an id it does not define");
  return found->second;
}

const SpirvModule::Decorations& SpirvModule::decorations(Id id) const {
  static const Decorations kNone;
  const auto found = decorations_.find(id);
  return found == decorations_.end() ? kNone : found->second;
}

const SpirvModule::Member& SpirvModule::member(Id type, std::uint32_t index) const {
  static const Member kNone;
  const auto found = members_.find({type, index});
  return found == members_.end() ? kNone : found->second;
}

std::string SpirvModule::name(Id id) const {
  const auto found = names_.find(id);
  return found == names_.end() ? std::string() : found->second;
}

SpirvModule::Id SpirvModule::pointee(Id variable) const {
  return definition(definition(variable)[0])[2];
}

// Operands of a constant: result type, result id, value.
std::uint32_t SpirvModule::value(Id id) const {
  const Instruction& constant = definition(id);
  const auto& spec_id = decorations(id).spec_id;
  if (constant.op == spv::Op::OpSpecConstant && spec_id && *spec_id < specialization_.size())
    return specialization_[*spec_id];
  if (constant.op != spv::Op::OpConstant && constant.op != spv::Op::OpSpecConstant)
    throw Error("a local size or array length that is computed from other constants is not understood");
  return constant[2];
}

}  // namespace scene_analyzer::gpu
