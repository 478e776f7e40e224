// glTF before Assimp sees it, .glb where it begins so, else .gltf: accepted, or refused with a sentence of
// ours.
#include <new>

#include "asset_in_memory.h"
#include "base/error.h"
#include "import/gltf_builder.h"
#include "import/gltf_check.h"
#include "target.h"

namespace scene_analyzer::fuzz {

std::vector<std::string> seeds() {
  import::QuadGltf plain, rich;
  rich.root["accessors"][0]["sparse"] = {{"count", 1},
                                         {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                         {"values", {{"bufferView", 0}}}};
  rich.root["skins"] = {{{"joints", {0}}}};
  rich.root["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"children", {1, 2}}}, {{"mesh", 0}}, {{"mesh", 0}}};
  rich.root["bufferViews"][0]["byteStride"] = 12;
  rich.root["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 5}});
  rich.root["extensionsRequired"] = {"KHR_materials_unlit"};
  rich.root["materials"] = {{{"name", "red"}}};
  import::QuadGltf outside = plain;
  outside.root["buffers"][0]["uri"] = "b.bin";
  return {plain.text(), plain.binary(), rich.text(), rich.binary(), outside.root.dump()};
}

namespace {

import::ExpectedGltf check(std::string_view bytes){set_asset(bytes);
import::AssetFiles files(bytes.starts_with("glTF") ? "asset.glb" : "asset.gltf");
std::vector<std::string> warnings;
return check_gltf(files, warnings);
}  // namespace

}  // namespace scene_analyzer::fuzz
}  // namespace scene_analyzer::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scene_analyzer;
  fuzz::enter_folder();
  import::ExpectedGltf expected;
  try {
    expected = fuzz::check(fuzz::text_of(data, size));
  } catch (const InputError& error) {
    fuzz::require(*error.what() != '\0', "a refusal has a reason");
    return 0;
  }
  // What Assimp gets in place of the file holds the same, and needs no other file in its place.
  if (expected.replacement.empty()) return 0;
  const import::ExpectedGltf again = fuzz::check(expected.replacement);
  fuzz::require(again.triangles == expected.triangles && again.materials == expected.materials,
                "without skins the file holds the same triangles");
  return 0;
}
