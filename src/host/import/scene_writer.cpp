#include "import/scene_writer.h"

#include <assimp/commonMetaData.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "import/appearance.h"
#include "import/node_walk.h"
#include "import/texture_writer.h"
#include "import/warnings.h"
#include "mesh/scene.h"

namespace scene_analyzer::import {
namespace {

constexpr std::string_view kImporterSuffix = " Importer";

std::string_view view(const aiString& text) {
  return {text.data, text.length};
}

// Values go out in blocks: one system call for many, and never a second copy of a mesh.
template <typename T>
class BlockWriter {
 public:
  explicit BlockWriter(wire::Writer& writer) : writer_(writer) {
    block_.reserve(kBlock);
    writer_.begin_array();
  }
  void put(T value) {
    block_.push_back(value);
    if (block_.size() == kBlock) flush();
  }
  void end() {
    flush();
    writer_.end_array(sizeof(T));
  }

 private:
  static constexpr std::size_t kBlock = 1 << 16;
  void flush() {
    writer_.append(std::span<const T>(block_));
    block_.clear();
  }
  wire::Writer& writer_;
  std::vector<T> block_;
};

std::span<const aiFace> faces(const aiMesh& mesh) {
  return {mesh.mFaces, mesh.mFaces == nullptr ? 0 : mesh.mNumFaces};
}

// Points and lines are counted, not kept. Polygons that the triangulation left alone are cut into a fan.
std::uint64_t write_indices(const aiMesh& mesh, wire::Writer& writer) {
  BlockWriter<std::uint32_t> indices(writer);
  std::uint64_t skipped = 0;
  for (const aiFace& face : faces(mesh)) {
    if (face.mNumIndices < 3) ++skipped;
    for (unsigned corner = 2; corner < face.mNumIndices; ++corner) {
      indices.put(face.mIndices[0]);
      indices.put(face.mIndices[corner - 1]);
      indices.put(face.mIndices[corner]);
    }
  }
  indices.end();
  return skipped;
}

void write_positions(const aiMesh& mesh, wire::Writer& writer) {
  static_assert(sizeof(aiVector3D) == 3 * sizeof(float), "positions are written as they lie in memory");
  writer.begin_array();
  if (mesh.mVertices != nullptr)
    writer.append(std::span<const float>(&mesh.mVertices[0].x, std::size_t{3} * mesh.mNumVertices));
  writer.end_array(sizeof(float));
}

void write_texture_coordinates(const aiMesh& mesh, wire::Writer& writer) {
  BlockWriter<float> coordinates(writer);
  if (mesh.HasTextureCoords(0) && mesh.mVertices != nullptr)
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      coordinates.put(mesh.mTextureCoords[0][i].x);
      coordinates.put(mesh.mTextureCoords[0][i].y);
    }
  coordinates.end();
}

// The big arrays only: a million small ones of the faces go when the process does.
void free_vertices(aiMesh& mesh) {
  for (aiVector3D** array : {&mesh.mVertices, &mesh.mNormals, &mesh.mTangents, &mesh.mBitangents}) {
    delete[] * array;
    *array = nullptr;
  }
  for (aiVector3D*& array : mesh.mTextureCoords) {
    delete[] array;
    array = nullptr;
  }
}

void write_meshes(aiScene& scene, wire::Writer& writer) {
  writer.number(std::uint64_t{scene.mNumMeshes});
  for (aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes)) {
    writer.string(view(mesh->mName));
    write_positions(*mesh, writer);
    const std::uint64_t skipped = write_indices(*mesh, writer);
    write_texture_coordinates(*mesh, writer);
    writer.number(std::uint32_t{mesh->mMaterialIndex});
    writer.number(skipped);
    free_vertices(*mesh);
  }
}

void write_instances(std::span<const NodeMesh> instances, wire::Writer& writer) {
  writer.number(std::uint64_t{instances.size()});
  for (const NodeMesh& instance : instances) {
    writer.number(instance.mesh);
    writer.string(view(instance.node->mName));
    for (const double element : instance.world) writer.number(element);
  }
}

void write_files(const AssetFiles& files, wire::Writer& writer) {
  writer.number(std::uint64_t{files.files().size()});
  for (const mesh::ReferencedFile& file : files.files()) {
    writer.string(file.path);
    writer.number(std::uint8_t{file.found});
  }
}

// "Autodesk FBX Importer" -> "Autodesk FBX".
std::string format_name(const aiScene& scene) {
  aiString format;
  if (scene.mMetaData == nullptr || !scene.mMetaData->Get(AI_METADATA_SOURCE_FORMAT, format)) return {};
  std::string_view name = view(format);
  if (name.ends_with(kImporterSuffix)) name.remove_suffix(kImporterSuffix.size());
  return std::string(name);
}

void write_strings(const std::vector<std::string>& strings, wire::Writer& writer) {
  writer.number(std::uint64_t{strings.size()});
  for (const std::string& text : strings) writer.string(text);
}

}  // namespace

std::uint64_t count_triangles(const aiScene& scene) {
  std::uint64_t triangles = 0;
  for (const aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes))
    for (const aiFace& face : faces(*mesh)) triangles += face.mNumIndices < 3 ? 0 : face.mNumIndices - 2;
  return triangles;
}

void write_scene(aiScene& scene, std::size_t file_materials, AssetFiles& files,
                 std::vector<std::string> warnings, Textures textures, wire::Writer& writer) {
  const std::string format = format_name(scene);
  const Conventions conventions = conventions_of(scene, format);
  Appearance appearance = collect_appearance(scene, files, warnings);
  for (std::size_t i = file_materials; i < appearance.materials.size(); ++i)
    appearance.materials[i].base_color.reset();
  const std::vector<NodeMesh> instances = walk_nodes(scene);
  warn_about_meshes(scene, instances, warnings);
  warn_about_files(files, warnings);

  writer.string(format);
  writer.number(std::uint8_t{conventions.unit_scale.has_value()});
  writer.number(conventions.unit_scale.value_or(0.0));
  writer.number(std::uint8_t{conventions.up_axis.has_value()});
  writer.string(conventions.up_axis.value_or(""));
  write_files(files, writer);
  write_textures(appearance, textures, warnings, writer);
  write_materials(appearance.materials, writer);
  write_strings(warnings, writer);  // behind the textures: they are decoded as they are written
  write_meshes(scene, writer);
  write_instances(instances, writer);
  writer.finish(wire::Status::kScene);
}

}  // namespace scene_analyzer::import
