// Required extensions: a tested list, everything else is refused by name.
#include <gmock/gmock.h>

#include "import/gltf_builder.h"
#include "import/temp_folder.h"

namespace scene_analyzer::import {
namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;

QuadGltf requiring(const char* extension) {
  QuadGltf quad;
  quad.root["extensionsUsed"] = {extension};
  quad.root["extensionsRequired"] = {extension};
  quad.root["materials"] = {{{"name", "m"}, {"extensions", {{extension, nlohmann::json::object()}}}}};
  quad.root["meshes"][0]["primitives"][0]["material"] = 0;
  return quad;
}

class TestedExtension : public testing::TestWithParam<const char*> {};

TEST_P(TestedExtension, LeavesGeometryAlone) {
  const QuadGltf quad = requiring(GetParam());
  const TempFolder folder;
  const mesh::Scene scene = import_asset(folder.write("quad.gltf", quad.text()));
  EXPECT_THAT(scene.meshes.at(0).positions, ElementsAreArray(quad.positions));
  EXPECT_THAT(scene.meshes.at(0).indices, ElementsAreArray(quad.indices));
  EXPECT_EQ(scene.instances.at(0).world, mesh::kIdentity4);
}

INSTANTIATE_TEST_SUITE_P(List, TestedExtension,
                         testing::Values("KHR_materials_unlit", "KHR_materials_pbrSpecularGlossiness",
                                         "KHR_materials_clearcoat", "KHR_materials_variants",
                                         "KHR_draco_mesh_compression", "KHR_lights_punctual",
                                         "KHR_texture_basisu", "KHR_texture_transform", "KHR_xmp",
                                         "KHR_xmp_json_ld", "EXT_texture_webp", "EXT_texture_avif",
                                         "MSFT_texture_dds", "EXT_lights_image_based"),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST(ImportGltfExtensions, OthersAreRefusedByName) {
  const TempFolder folder;
  for (const char* extension : {"KHR_mesh_quantization", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing",
                                "VENDOR_unknown", "KHR_material", ""}) {
    const std::string message = refusal(folder.write("quad.gltf", requiring(extension).text()));
    EXPECT_THAT(message, HasSubstr("requires the glTF extension " + std::string(extension))) << extension;
  }
}

TEST(ImportGltfExtensions, OnesThatAreOnlyUsedPass) {
  QuadGltf quad = requiring("VENDOR_unknown");
  quad.root.erase("extensionsRequired");
  const TempFolder folder;
  EXPECT_EQ(refusal(folder.write("quad.gltf", quad.text())), "");
}

}  // namespace
}  // namespace scene_analyzer::import
