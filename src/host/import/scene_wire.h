// scene_wire.h — Reads a scene out of a worker's answer.
#pragma once

#include <memory>

#include "import/wire.h"
#include "mesh/scene.h"

namespace scene_analyzer::import {

// The record of status kScene, in this order; counts are u64:
//   string format | u8 has, f64 unit_scale | u8 has, string up_axis
//   files:     count, { string path, u8 found }            the asset itself first
//   textures:  count, { string path, array u8 encoded, u32 width, u32 height, array u8 pixels }
//   materials: count, { string name, u8 has, f32 x 4 color, u8 has, u32 texture }
//   warnings:  count, { string }
//   meshes:    count, { string name, array f32 positions, array u32 indices, array f32 uv, u32 material,
//                       u64 skipped }
//   instances: count, { u32 mesh, string node, f64 x 16 world }
//
// Arrays stay where they are: the scene's spans point into the reader's memory, which the caller keeps alive
// in Scene::storage. Names are cleaned. Throws wire::Malformed, and InputError (without the asset's name)
// when a triangle asks for a vertex that is not there. Coordinates and matrices may hold NaN and infinity,
// as files do: that is a warning. Cost: one pass over indices and positions.
mesh::Scene read_scene(wire::Reader& reader);

}  // namespace scene_analyzer::import
