#include "report/glb_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <stdexcept>
#include <utility>

namespace scene_analyzer::report {
namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error("not a GLB file: " + what);
}

template <typename T>
T number_at(const std::string& bytes, std::size_t offset) {
  require(offset + sizeof(T) <= bytes.size(), "a number beyond the end");
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

struct MeshStorage {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
  std::shared_ptr<const void> before;
};

// The inverse of what COLOR_0 demands, by the formula of IEC 61966-2-1.
double to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace

void ExportedScene::add_asset(const std::string& path) {
  scenes_.emplace_back().asset = path;
  analysis::AssetAnalysis& asset = assets_.emplace_back();
  asset.asset = path;
  asset.format = "glTF2";
}

std::uint32_t ExportedScene::add_mesh(const std::string& name, std::vector<float> positions,
                                      std::vector<std::uint32_t> indices) {
  const auto stored =
      std::make_shared<MeshStorage>(MeshStorage{std::move(positions), std::move(indices), scene().storage});
  scene().storage = stored;
  mesh::TriangleMesh& mesh = scene().meshes.emplace_back();
  mesh.name = name;
  mesh.positions = stored->positions;
  mesh.indices = stored->indices;
  return static_cast<std::uint32_t>(scene().meshes.size() - 1);
}

void ExportedScene::add_instance(std::uint32_t mesh, const std::string& node, const mesh::Matrix4& world,
                                 const std::optional<ratings::Rgb>& color) {
  scene().instances.push_back({.mesh = mesh, .node = node, .world = world});
  const auto index = static_cast<std::uint32_t>(analysis().geometries.size());
  analysis::GeometryAnalysis& geometry = analysis().geometries.emplace_back();
  geometry.mesh = mesh;
  geometry.source_triangles = geometry.triangles = scene().meshes[mesh].triangle_count();
  geometry.surface_area = 1.0 + index;
  geometry.planar_group_variation = 1.0 / (2.0 + static_cast<double>(colors_.size()));
  analysis::InstanceAnalysis& instance = analysis().instances.emplace_back();
  instance.geometry = index;
  instance.node = node;
  instance.mesh = scene().meshes[mesh].name;
  instance.world = world;
  instance.bounds = analysis::Bounds{{0, 0, 0}, {1, 1, 1}};
  colors_.push_back(color);
}

SceneReport ExportedScene::report() const {
  SceneReport report;
  report.tool_version = "1.2.3";
  report.assets = assets_;
  report.rating = ratings::rate(assets_, report.options);
  return report;
}

std::string ExportedScene::file() const {
  std::vector<const mesh::Scene*> scenes;
  for (const mesh::Scene& scene : scenes_) scenes.push_back(&scene);
  return glb(report(), scenes, colors_);
}

std::vector<float> tetrahedron_positions() {
  return {0, 0, 0, 1.1f, 0, 0, 0, 2.3f, 0, 0, 0, -3.7f};
}

std::vector<std::uint32_t> tetrahedron_indices() {
  return {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
}

std::vector<float> many_positions(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(-1, 1);
  std::vector<float> positions(3 * count);
  for (float& value : positions) value = coordinate(random);
  return positions;
}

ExportedScene two_exported_assets() {
  ExportedScene result;
  result.add_asset("models/room.glb");
  const std::uint32_t tetrahedron =
      result.add_mesh("tetrahedron", tetrahedron_positions(), tetrahedron_indices());
  const std::uint32_t square =
      result.add_mesh("square", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 0, 2, 3});
  const mesh::Matrix4 turned = {0, -2, 0, 1, 2, 0, 0, 2, 0, 0, 2, 3, 0, 0, 0, 1};
  result.add_instance(tetrahedron, "left", mesh::kIdentity4, kRed);
  result.add_instance(tetrahedron, "right", turned, kGreen);
  result.add_instance(square, "square", {-1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1});
  result.add_asset("models/part.fbx");
  result.analysis().up_axis = "+Z";
  result.analysis().unit_scale = 0.01;
  result.add_instance(
      result.add_mesh("plate", {0, 0, 0, 100, 0, 0, 100, 100, 0, 0, 100, 0}, {0, 1, 2, 0, 2, 3}), "plate",
      kShear, ratings::Rgb{0.3, 0.2, 0.9});
  return result;
}

ExportedScene one_mesh(std::vector<float> positions, std::vector<std::uint32_t> indices,
                       const mesh::Matrix4& world) {
  ExportedScene result;
  result.add_asset("one.glb");
  result.add_instance(result.add_mesh("mesh", std::move(positions), std::move(indices)), "node", world);
  return result;
}

ParsedGlb::ParsedGlb(const std::string& file) {
  require(file.starts_with("glTF") && number_at<std::uint32_t>(file, 4) == 2, "head");
  require(number_at<std::uint32_t>(file, 8) == file.size(), "length");
  const std::size_t json_bytes = number_at<std::uint32_t>(file, 12);
  require(file.compare(16, 4, "JSON") == 0 && json_bytes % 4 == 0, "JSON chunk");
  const std::string text = file.substr(20, json_bytes);
  const std::size_t end = text.find_last_not_of(' ') + 1;
  require(text.size() == json_bytes && text.size() - end < 4 && text[end - 1] == '}',
          "padding of the JSON chunk");
  json = nlohmann::ordered_json::parse(text);
  if (const std::size_t at = 20 + json_bytes; at < file.size()) {
    const std::size_t bytes = number_at<std::uint32_t>(file, at);
    require(file.compare(at + 4, 4, std::string("BIN\0", 4)) == 0 && bytes % 4 == 0, "binary chunk");
    binary = file.substr(at + 8);
    require(binary.size() == bytes && !binary.empty(), "length of the binary chunk");
  }
  require(json.contains("buffers") == !binary.empty(), "buffer");
  if (binary.empty()) return;
  require(json["buffers"].size() == 1 && json["buffers"][0]["byteLength"] == binary.size(), "buffer");
  check_views();
  for (std::size_t i = 0; i < json["accessors"].size(); ++i) check_accessor(i);
  check_primitives();
}

template <typename T, std::size_t N>
std::vector<std::array<T, N>> ParsedGlb::elements(std::size_t accessor, int component_type,
                                                  const std::string& type) const {
  const nlohmann::ordered_json& described = json.at("accessors").at(accessor);
  require(described.at("componentType") == component_type && described.at("type") == type, "type");
  const nlohmann::ordered_json& view =
      json.at("bufferViews").at(described.at("bufferView").get<std::size_t>());
  const auto offset = view.at("byteOffset").get<std::size_t>(),
             bytes = view.at("byteLength").get<std::size_t>();
  const auto count = described.at("count").get<std::size_t>();
  require(view.value("byteStride", sizeof(T) * N) == sizeof(T) * N, "stride");
  require(offset % 4 == 0 && offset + bytes <= binary.size(), "view");
  require(count > 0 && count * sizeof(T) * N <= bytes, "an accessor beyond its view");
  std::vector<std::array<T, N>> result(count);
  std::memcpy(result.data(), binary.data() + offset, count * sizeof(T) * N);
  return result;
}

std::vector<Position> ParsedGlb::positions(std::size_t accessor) const {
  return elements<float, 3>(accessor, 5126, "VEC3");
}

std::vector<std::uint32_t> ParsedGlb::indices(std::size_t accessor) const {
  std::vector<std::uint32_t> result;
  if (json.at("accessors").at(accessor).at("componentType") == 5123)
    for (const auto& [index] : elements<std::uint16_t, 1>(accessor, 5123, "SCALAR")) result.push_back(index);
  else
    for (const auto& [index] : elements<std::uint32_t, 1>(accessor, 5125, "SCALAR")) result.push_back(index);
  return result;
}

std::vector<std::array<std::uint16_t, 4>> ParsedGlb::colors(std::size_t accessor) const {
  require(json.at("accessors").at(accessor).at("normalized") == true, "colours have to be normalised");
  return elements<std::uint16_t, 4>(accessor, 5123, "VEC4");
}

// One after the other, without overlap, filled up to multiples of 4 with zeros.
void ParsedGlb::check_views() const {
  std::size_t at = 0;
  for (const auto& view : json.at("bufferViews")) {
    require(view.at("byteOffset") == at, "place of a view");
    const std::size_t end = at + view.at("byteLength").get<std::size_t>();
    at = (end + 3) / 4 * 4;
    require(at <= binary.size(), "a view beyond the buffer");
    require(binary.compare(end, at - end, std::string(at - end, '\0')) == 0, "padding of a view");
  }
  require(at == binary.size(), "bytes of no view");
}

void ParsedGlb::check_accessor(std::size_t index) const {
  const nlohmann::ordered_json& accessor = json.at("accessors").at(index);
  if (accessor.at("type") != "VEC3") {
    if (accessor.at("type") == "SCALAR")
      indices(index);
    else
      colors(index);
    return;
  }
  Position min, max;
  min.fill(INFINITY), max.fill(-INFINITY);
  for (const Position& position : positions(index))
    for (std::size_t axis = 0; axis < 3; ++axis) {
      require(std::isfinite(position[axis]), "a position that is not finite");
      min[axis] = std::min(min[axis], position[axis]);
      max[axis] = std::max(max[axis], position[axis]);
    }
  require(accessor.at("min") == min && accessor.at("max") == max, "bounds");
}

void ParsedGlb::check_primitives() const {
  for (const auto& mesh : json.at("meshes"))
    for (const auto& primitive : mesh.at("primitives")) {
      const std::size_t vertices = positions(primitive.at("attributes").at("POSITION")).size();
      require(colors(primitive.at("attributes").at("COLOR_0")).size() == vertices, "as many colours");
      const std::vector<std::uint32_t> corners = indices(primitive.at("indices"));
      require(corners.size() % 3 == 0 && *std::max_element(corners.begin(), corners.end()) < vertices,
              "indices");
      require(primitive.at("material") == 0, "material");
    }
}

const nlohmann::ordered_json& ParsedGlb::instance(std::size_t row) const {
  return json.at("nodes").at(json.at("scenes").at(0).at("nodes").size() + row);
}

const nlohmann::ordered_json& ParsedGlb::primitive_of(std::size_t row) const {
  return json.at("meshes").at(instance(row).at("mesh").get<std::size_t>()).at("primitives").at(0);
}

std::size_t ParsedGlb::position_accessor(std::size_t row) const {
  return primitive_of(row).at("attributes").at("POSITION");
}

std::string ParsedGlb::color_of(std::size_t row) const {
  const auto all = colors(primitive_of(row).at("attributes").at("COLOR_0"));
  for (const auto& one : all) require(one == all.front() && one[3] == 0xFFFF, "one opaque colour");
  ratings::Rgb color;
  for (std::size_t i = 0; i < 3; ++i) color[i] = to_srgb(all.front()[i] / 65535.0);
  return ratings::to_hex(color);
}

}  // namespace scene_analyzer::report
