// spirv_module.h — A SPIR-V module's declarations: types, constants, variables, decorations. Function bodies
// are not read. Vulkan-free. Every accessor throws gpu::Error where the words contradict themselves.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <spirv/unified1/spirv.hpp11>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace scene_analyzer::gpu {

class SpirvModule {
 public:
  using Words = std::span<const std::uint32_t>;
  using Id = std::uint32_t;

  struct Instruction {
    spv::Op op{};
    Words operands;  // without the first word

    std::uint32_t operator[](std::size_t index) const;
    Words from(std::size_t index) const;
  };
  struct Member {
    std::string name;
    std::uint32_t offset = 0;
    std::uint32_t matrix_stride = 0;
  };
  struct Decorations {
    std::optional<std::uint32_t> set, binding, spec_id, array_stride;
    bool is_buffer_block = false;
  };
  struct Variable {
    Id id = 0;
    spv::StorageClass storage{};
  };

  // Both must outlive the module. Throws gpu::Error when the words are no module with one compute entry
  // point.
  SpirvModule(Words words, Words specialization);

  const std::vector<Variable>& variables() const { return variables_; }
  std::array<std::uint32_t, 3> local_size() const;

  // Of a type, constant or variable. No type contains itself.
  const Instruction& definition(Id id) const;
  const Decorations& decorations(Id id) const;
  const Member& member(Id type, std::uint32_t index) const;
  std::string name(Id id) const;           // "" when it has none
  Id pointee(Id variable) const;           // the type that the variable's pointer type points to
  std::uint32_t value(Id constant) const;  // 32-bit, specialised where the module and the caller do

 private:
  void read(const Instruction& instruction);
  void read_declaration(const Instruction& instruction);
  void read_entry_point(const Instruction& instruction);
  void read_mode(const Instruction& instruction);
  void read_decoration(const Instruction& instruction);
  void read_member_decoration(const Instruction& instruction);
  void define(Id id, const Instruction& instruction, const Words& parts);

  Words specialization_;
  std::unordered_map<Id, Instruction> definitions_;
  std::unordered_map<Id, Decorations> decorations_;
  std::unordered_map<Id, std::string> names_;
  std::map<std::pair<Id, std::uint32_t>, Member> members_;
  std::vector<Variable> variables_;
  std::array<std::uint32_t, 3> local_size_{1, 1, 1};  // numbers, or ids of constants
  bool local_size_is_ids_ = false;
  std::optional<Id> workgroup_size_;  // the constant decorated BuiltIn WorkgroupSize, which outranks the mode
  int entry_points_ = 0;
};

}  // namespace scene_analyzer::gpu
