// Textures become pixels when that is asked for, and nothing about them keeps an asset from being imported.
#include <gmock/gmock.h>

#include "import/gltf_builder.h"
#include "import/image_builder.h"
#include "import/memory_file.h"
#include "import/temp_folder.h"
#include "import/texture_writer.h"

namespace scene_analyzer::import {
namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Pixels kFour = {{255, 0, 0, 255}, {0, 255, 0, 128}, {0, 0, 255, 0}, {10, 20, 30, 40}};

Pixels pixels_of(const mesh::Texture& texture) {
  Pixels pixels(texture.pixels.size() / 4);
  for (std::size_t i = 0; i < texture.pixels.size(); ++i) pixels[i / 4][i % 4] = texture.pixels[i];
  return pixels;
}

// A quad whose material shows an image with this address.
QuadGltf textured_quad(const std::string& uri) {
  QuadGltf quad;
  const nlohmann::json material = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};
  quad.root["materials"] = {material, material};
  quad.root["textures"] = {{{"source", 0}}};
  quad.root["images"] = {{{"uri", uri}}};
  nlohmann::json& primitives = quad.root["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  for (int i = 0; i < 2; ++i) primitives[i]["material"] = i;
  return quad;
}

std::string data_uri(const std::string& file) {
  return "data:image/png;base64," + base64({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()});
}

// An OBJ and its material library: one triangle for each of the textures.
fs::path write_obj(const TempFolder& folder, const std::vector<std::string>& textures) {
  std::string obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n", library;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const std::string material = "m" + std::to_string(i);
    library += "newmtl " + material + "\nmap_Kd " + textures[i] + "\n";
    obj += "usemtl " + material + "\nf 1/1 2/1 3/1\n";
  }
  folder.write("a.mtl", library);
  return folder.write("a.obj", obj);
}

mesh::Scene decoded(const fs::path& asset) {
  return import_asset(asset, {}, Textures::kDecode);
}

// The scene of a triangle with an image called "image".
mesh::Scene with_image(const std::string& image) {
  const TempFolder folder;
  folder.write("image", image);
  return decoded(write_obj(folder, {"image"}));
}

TEST(ImportTexture, EmbeddedPng) {
  const TempFolder folder;
  const QuadGltf quad = textured_quad(data_uri(png(2, 2, kFour)));
  for (const fs::path& asset : {folder.write("a.gltf", quad.text()), folder.write("a.glb", quad.binary())}) {
    const mesh::Scene scene = decoded(asset);
    ASSERT_EQ(scene.textures.size(), 1u) << "two materials share it";
    EXPECT_EQ(scene.textures[0].width, 2u);
    EXPECT_EQ(scene.textures[0].height, 2u);
    EXPECT_EQ(pixels_of(scene.textures[0]), kFour);
    EXPECT_FALSE(scene.textures[0].encoded.empty());
    EXPECT_THAT(scene.warnings, IsEmpty());
  }
}

TEST(ImportTexture, NothingIsDecodedUnlessAskedFor) {
  const TempFolder folder;
  folder.write("broken.png", "nothing");
  for (const fs::path& asset : {folder.write("a.gltf", textured_quad(data_uri(png(2, 2, kFour))).text()),
                                write_obj(folder, {"broken.png"})}) {
    const mesh::Scene scene = import_asset(asset);
    EXPECT_EQ(scene.textures.at(0).width, 0u);
    EXPECT_EQ(scene.textures.at(0).height, 0u);
    EXPECT_TRUE(scene.textures.at(0).pixels.empty());
    EXPECT_THAT(scene.warnings, IsEmpty());
  }
}

TEST(ImportTexture, FilesBesideTheAsset) {
  const TempFolder folder;
  folder.write("sub/my image.tga", tga(4, 1, kFour));
  folder.write("b.bmp", bmp(1, 4, kFour));
  const mesh::Scene obj = decoded(write_obj(folder, {"b.bmp", "sub\\my image.tga", "b.bmp"}));
  ASSERT_EQ(obj.textures.size(), 2u);
  EXPECT_EQ(pixels_of(obj.textures[0]),
            (Pixels{{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {10, 20, 30, 255}}));
  EXPECT_EQ(obj.textures[0].height, 4u);
  EXPECT_EQ(pixels_of(obj.textures[1]), kFour);
  EXPECT_EQ(obj.textures[1].width, 4u);
  EXPECT_THAT(obj.warnings, IsEmpty());
  const mesh::Scene gltf = decoded(folder.write("a.gltf", textured_quad("sub/my%20image.tga").text()));
  EXPECT_EQ(pixels_of(gltf.textures.at(0)), kFour);
}

// What a renderer relies on: v = 1 is the first row in glTF as in OBJ (see ImportScene), though files count
// in opposite directions.
TEST(ImportTexture, TheFirstRowIsAtTheUpperEndOfV) {
  const TempFolder folder;
  QuadGltf quad = textured_quad(data_uri(png(1, 2, {{1, 1, 1, 1}, {2, 2, 2, 2}})));
  quad.root["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  const std::array<float, 8> coordinates = {0, 1, 1, 1, 1, 0, 0, 0};  // glTF: v grows downwards
  const std::string bytes(reinterpret_cast<const char*>(coordinates.data()), sizeof coordinates);
  folder.write("uv.bin", bytes);
  quad.root["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(quad.buffer());
  quad.root["buffers"].push_back({{"byteLength", 32}, {"uri", "uv.bin"}});
  quad.root["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 32}});
  for (nlohmann::json& primitive : quad.root["meshes"][0]["primitives"])
    primitive["attributes"]["TEXCOORD_0"] = 2;
  const mesh::Scene scene = decoded(folder.write("a.gltf", quad.text()));
  EXPECT_THAT(scene.meshes.at(0).texture_coordinates, ElementsAre(0, 0, 1, 0, 1, 1, 0, 1))
      << "the quad's lower left corner has the picture's";
  EXPECT_EQ(pixels_of(scene.textures.at(0)).front(), (Pixel{1, 1, 1, 1})) << "the picture's upper row";
}

TEST(ImportTexture, LargeOnesAreHalved) {
  Pixels line(2048), image(std::size_t{2048} * 1024);
  for (std::uint32_t x = 0; x < 2048; ++x) {
    const auto i = static_cast<std::uint8_t>(x / 8);
    line[x] = x % 2 == 0 ? Pixel{i, 0, 255, 9} : Pixel{i, 3, 0, 10};
    for (std::uint32_t y = 0; y < 1024; ++y)
      image[std::size_t{y} * 2048 + x] = {i, static_cast<std::uint8_t>(y / 4),
                                          static_cast<std::uint8_t>(4 * (y % 2) + 2 * (x % 2)), 255};
  }
  const mesh::Scene lines = with_image(tga(2048, 1, line));
  ASSERT_EQ(lines.textures.at(0).width, 1024u);
  ASSERT_EQ(lines.textures[0].height, 1u);
  const Pixels halved = pixels_of(lines.textures[0]);
  for (std::size_t x = 0; x < 1024; ++x)
    ASSERT_EQ(halved[x], (Pixel{static_cast<std::uint8_t>(x / 4), 2, 128, 10})) << "halves are rounded up";

  const mesh::Scene images = with_image(tga(2048, 1024, image));
  ASSERT_EQ(images.textures.at(0).width, 1024u);
  ASSERT_EQ(images.textures[0].height, 512u);
  const Pixels quartered = pixels_of(images.textures[0]);
  for (std::size_t i = 0; i < quartered.size(); ++i)
    ASSERT_EQ(quartered[i], (Pixel{static_cast<std::uint8_t>(i % 1024 / 4),
                                   static_cast<std::uint8_t>(i / 1024 / 2), 3, 255}));
}

TEST(ImportTexture, LyingHeadersCostNothing) {
  EXPECT_THAT(with_image(png(20000, 4, kFour)).warnings,
              ElementsAre("texture \"image\" cannot be decoded: 20000 x 4 pixels, and no side may have more "
                          "than 16384"));
  EXPECT_THAT(with_image(png(16384, 16384, kFour)).warnings,
              ElementsAre(HasSubstr("16384 x 16384 pixels, and no more than 67108864 are decoded")));
  EXPECT_THAT(with_image(tga(16384, 4096, kFour)).warnings,
              ElementsAre(HasSubstr(
                  "it is damaged: for 16384 x 4096 pixels it needs 268435474 bytes, and it has 34")));
  EXPECT_THAT(with_image(bmp(2, 2, kFour).substr(0, 65)).warnings,
              ElementsAre(HasSubstr("needs 66 bytes, and it has 65")));
  EXPECT_THAT(with_image(png(1000, 1000, kFour)).warnings, ElementsAre(HasSubstr("it is damaged")));
}

TEST(ImportTexture, WhatCannotBeDecodedIsOneWarning) {
  const TempFolder folder;
  std::string broken = png(2, 2, kFour);
  broken.resize(broken.size() - 20);
  folder.write("broken.png", broken);
  folder.write("new.webp", std::string("RIFF\x20\0\0\0WEBPVP8 ", 16) + std::string(20, 'x'));
  folder.write("new.ktx2", "\xABKTX 20\xBB\r\n\x1A\n" + std::string(80, '\0'));
  folder.write("fine.png", png(2, 2, kFour));
  const mesh::Scene scene =
      decoded(write_obj(folder, {"broken.png", "new.webp", "fine.png", "new.ktx2", "gone.png"}));
  EXPECT_EQ(scene.meshes.size(), 5u);
  ASSERT_EQ(scene.textures.size(), 5u);
  for (const std::size_t i : {0u, 1u, 3u, 4u}) EXPECT_TRUE(scene.textures[i].pixels.empty()) << i;
  EXPECT_EQ(pixels_of(scene.textures[2]), kFour);
  EXPECT_THAT(
      scene.warnings,
      ElementsAre(HasSubstr("\"gone.png\" is missing"),
                  testing::AllOf(HasSubstr("3 textures cannot be decoded: \"broken.png\" (it is damaged: "),
                                 HasSubstr("\"new.webp\" (it is damaged or no PNG"),
                                 HasSubstr("\"new.ktx2\" (it is damaged or no PNG"))));

  const mesh::Scene embedded = decoded(folder.write("a.gltf", textured_quad(data_uri(broken)).text()));
  EXPECT_THAT(embedded.warnings, ElementsAre(HasSubstr("cannot be decoded: it is damaged")));
}

TEST(ImportTexture, NoneFromOutsideTheFolder) {
  const TempFolder store, folder;
  folder.write("outside.png", png(2, 2, kFour));
  folder.write("in/inside.png", png(2, 2, kFour));
  const std::string library = "newmtl a\nmap_Kd ../outside.png\nnewmtl b\nmap_Kd link.png\n";
  folder.write("in/a.mtl", library);
  fs::create_symlink(store.write("linked.png", png(2, 2, kFour)), folder.path() / "in/link.png");
  const mesh::Scene scene = decoded(folder.write(
      "in/a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n"));
  ASSERT_EQ(scene.textures.size(), 2u);
  for (const mesh::Texture& texture : scene.textures) EXPECT_TRUE(texture.pixels.empty()) << texture.path;
  EXPECT_TRUE(mentions(scene.warnings, "2 references lead out of the asset's folder"));
  EXPECT_TRUE(mentions(scene.warnings, "\"../outside.png\", \"link.png\""));
}

TEST(ImportTexture, TexturesThatTakeTooLongAreLeftOut) {
  const TempFolder folder;
  folder.write("a.tga", plain_tga(8192, 8192, {1, 2, 3, 4}));
  std::vector<std::string> names = {"a.tga"};
  for (int i = 0; i < 100; ++i) names.push_back("./" + names.back());
  const mesh::Scene scene = import_asset(write_obj(folder, names), {.seconds = 2}, Textures::kDecode);
  EXPECT_EQ(scene.meshes.size(), names.size());
  EXPECT_TRUE(scene.textures.at(0).pixels.empty());
  EXPECT_THAT(scene.warnings,
              ElementsAre("no texture was decoded, as with textures importing it takes longer than the limit "
                          "of 2 s (--import-timeout)"));
}

TEST(ImportTexture, AllTogetherHaveALimit) {
  const std::string file = tga(4, 1, kFour);
  Appearance appearance;
  for (const char* name : {"a", "b", "c", "d"}) {
    mesh::Texture& texture = appearance.textures.emplace_back();
    texture.path = name;
    texture.encoded = {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
  }
  appearance.texture_files.resize(4);
  const MemoryFile memory;
  wire::Writer writer(memory.descriptor());
  std::vector<std::string> warnings;
  write_textures(appearance, Textures::kDecode, warnings, writer, 2 * 16);
  EXPECT_THAT(warnings,
              ElementsAre("2 textures cannot be decoded: \"c\" (the textures before it fill the "
                          "limit of 0 MiB), \"d\" (the textures before it fill the limit of 0 MiB)"));
}

}  // namespace
}  // namespace scene_analyzer::import
