// types.h — One language for parameter structs: included by GLSL and by C++.
//
// In GLSL blocks are declared `scalar`, so both sides have the same layout by rule; tests/interface compares
// member's offset in the SPIR-V with offsetof.
#ifndef SCENE_ANALYZER_INTERFACE_TYPES_H
#define SCENE_ANALYZER_INTERFACE_TYPES_H

#ifdef __cplusplus
#include <array>
#include <cstdint>
#define INTERFACE_BEGIN(room) namespace scene_analyzer::interface::room {
#define INTERFACE_END }
#define INTERFACE_ARRAY(type, name, count) std::array<type, count> name
namespace scene_analyzer::interface {
using uint = std::uint32_t;
}  // namespace scene_analyzer::interface
#define INTERFACE_CONST inline constexpr
#else
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#define INTERFACE_BEGIN(room)
#define INTERFACE_END
#define INTERFACE_ARRAY(type, name, count) type name[count]
#define INTERFACE_CONST const
#endif

#endif
