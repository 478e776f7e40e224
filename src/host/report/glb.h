// glb.h — A rated scene as binary glTF 2.0: geometry, rating colours as vertex colours, ratings as extras.
// Any viewer or modelling program opens it.
//
// Nodes: one per asset (scenes[0].nodes, named after the file, extras: the asset's entry of the JSON report)
// and below it one per mesh instance, in the report's order. An instance is named as its row in the table is;
// its extras are its row of the JSON report, and `left_out_triangles` with `left_out_because` where the mesh
// is not or not wholly in the file. scenes[0].extras: the JSON report without its meshes.
//
// Positions are those of the asset, in 32-bit floats as they came. glTF is +Y up, in metres: an asset that
// states another up axis or unit gets a node that is turned and scaled; one that states nothing is taken as
// it is. A node has translation, rotation and scale; the last row of its matrix is taken as 0 0 0 1, as in
// the analysis. What these cannot say (shear, a scale of 0) is applied to the positions, which are then
// stored once more.
//
// COLOR_0 is RGBA of 16 bits a channel, linear as glTF wants it; back in sRGB of 8 bits it is the given
// colour to the last bit. One material without texture multiplies it with white.
//
// Left out: triangles with a corner that is not finite, and instances whose matrix is not finite or is beyond
// 32-bit floats. Materials, textures, texture coordinates and the assets' own node trees are not exported.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "mesh/scene.h"
#include "ratings/ratings.h"
#include "report/report.h"

namespace scene_analyzer::report {

// `scenes` run along report.assets, `colors` (sRGB) along report.rating.meshes: the colour of each mesh
// instance; absent where it has no value, which makes it neutral grey (#808080).
//
// Same input, same bytes. The file holds the positions and indices of a mesh once, however many instances it
// has (12 bytes per vertex, 6 or 12 per triangle), per colour 8 bytes per vertex of the largest mesh with it,
// and 1 to 2 kB of JSON per instance. Cost: linear in these, and one look-up per instance; 100000 instances
// or 30 million triangles take a second or two. Memory: the file once, some 50 bytes per instance and some
// hundreds per mesh.
//
// Throws InputError when the file would be larger than the 4 GiB that GLB allows, before memory for it is
// taken, and when an asset is not the one that was analysed. The message does not name the output.
std::string glb(const SceneReport& report, std::span<const mesh::Scene* const> scenes,
                std::span<const std::optional<ratings::Rgb>> colors);

}  // namespace scene_analyzer::report
