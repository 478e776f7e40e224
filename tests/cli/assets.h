// assets.h — Small assets as text, for runs of the built program.
#pragma once

#include <fmt/format.h>

#include <string>

#include "cli/selftest_meshes.h"

namespace scene_analyzer {

// A cli::BuiltInMesh or a test_meshes::TestMesh.
template <typename Mesh>
std::string obj_of(const Mesh& mesh, const std::string& name) {
  std::string text = fmt::format("o {}\n", name);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
    text += fmt::format("v {} {} {}\n", mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    text +=
        fmt::format("f {} {} {}\n", mesh.indices[i] + 1, mesh.indices[i + 1] + 1, mesh.indices[i + 2] + 1);
  return text;
}

inline std::string cube_obj() {
  return obj_of(cli::cube(), "cube");
}
inline std::string leg_obj() {
  return obj_of(cli::prism(10, 1, 0.03, 0.12), "leg");
}

// A glTF asset with one triangle and `buffer_uri` as the place of its 36 bytes of positions.
inline std::string gltf_triangle(const std::string& buffer_uri) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"node"}],)"
         R"("meshes":[{"name":"triangle","primitives":[{"attributes":{"POSITION":0}}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")" +
         buffer_uri + "\"}]}";
}

// FBX with one triangle, in centimetres and with Z up.
inline std::string fbx_triangle() {
  return R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
  FBXHeaderVersion: 1003
  FBXVersion: 7400
}
GlobalSettings:  {
  Version: 1000
  Properties70:  {
    P: "UpAxis", "int", "Integer", "",2
    P: "UpAxisSign", "int", "Integer", "",1
    P: "UnitScaleFactor", "double", "Number", "",1
  }
}
Objects:  {
  Geometry: 1, "Geometry::g", "Mesh" {
    Vertices: *9 { a: 0,0,0,1,0,0,0,1,0 }
    PolygonVertexIndex: *3 { a: 0,1,-3 }
  }
  Model: 2, "Model::m", "Mesh" {
    Version: 232
  }
}
Connections:  {
  C: "OO",2,0
  C: "OO",1,2
}
)";
}

}  // namespace scene_analyzer
