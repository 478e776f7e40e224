#include "report/glb_document.h"

#include <filesystem>
#include <string>
#include <vector>

#include "report/document.h"
#include "report/glb_placement.h"

namespace scene_analyzer::report {
namespace {

using nlohmann::ordered_json;

constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;  // as OpenGL numbers them
constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;

template <std::size_t N>
ordered_json numbers(const std::array<double, N>& values) {
  ordered_json result = ordered_json::array();
  for (const double value : values) result.push_back(value + 0.0);  // -0 + 0 = 0
  return result;
}

void put_placement(ordered_json& node, const Placement& placement) {
  const Placement none;
  if (placement.translation != none.translation) node["translation"] = numbers(placement.translation);
  if (placement.rotation != none.rotation) node["rotation"] = numbers(placement.rotation);
  if (placement.scale != none.scale) node["scale"] = numbers(placement.scale);
}

// Lists are printed element by element: as a tree they would take some kilobytes per mesh.
class Document {
 public:
  Document(const SceneReport& report, std::span<const mesh::Scene* const> scenes, const GlbLayout& layout)
      : report_(report), scenes_(scenes), layout_(layout) {}

  void append_to(std::string& out) const {
    const ordered_json head = document_head(report_);
    const ordered_json asset = {{"version", "2.0"}, {"generator", "Scene Analyzer " + report_.tool_version}};
    out += "{\"asset\":" + print(asset) + ",\"scene\":0,\"scenes\":[" + print(scene(head)) + "]";
    const std::vector<ordered_json> tops = asset_nodes(head);
    out.reserve(out.size() + expected_size() + layout_.bytes);
    append_list(out, "nodes", tops.size() + layout_.instances.size(),
                [&](std::size_t i) { return i < tops.size() ? tops[i] : instance_node(i - tops.size()); });
    append_list(out, "meshes", layout_.meshes.size(), [&](std::size_t i) { return mesh(i); });
    append_list(out, "materials", layout_.meshes.empty() ? 0 : 1, [](std::size_t) { return material(); });
    append_list(out, "accessors", layout_.accessors.size(), [&](std::size_t i) { return accessor(i); });
    append_list(out, "bufferViews", layout_.views.size(), [&](std::size_t i) { return view(i); });
    append_list(out, "buffers", layout_.bytes == 0 ? 0 : 1, [&](std::size_t) {
      return ordered_json{{"byteLength", layout_.bytes}};
    });
    out += '}';
  }

 private:
  // Rows are alike: the first tells the size, so that hundreds of megabytes are not moved again and again.
  std::size_t expected_size() const {
    const std::size_t instances = layout_.instances.size();
    const std::size_t arrays = layout_.meshes.size() + layout_.accessors.size() + layout_.views.size();
    const std::size_t row = instances == 0 ? 0 : print(instance_node(0)).size() + 64;
    return instances * row + 256 * arrays + 4096 * report_.assets.size();
  }

  // glTF has no empty lists.
  template <typename Item>
  static void append_list(std::string& out, const char* name, std::size_t count, const Item& item) {
    if (count == 0) return;
    out.append(",\"").append(name).append("\":[");
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) out += ',';
      out += print(item(i));
    }
    out += ']';
  }

  ordered_json scene(const ordered_json& head) const {
    ordered_json result = ordered_json::object();
    for (std::size_t i = 0; i < report_.assets.size(); ++i) result["nodes"].push_back(i);
    result["extras"] = head;
    return result;
  }

  std::vector<ordered_json> asset_nodes(const ordered_json& head) const {
    std::vector<ordered_json> nodes;
    for (std::size_t i = 0; i < report_.assets.size(); ++i) {
      const analysis::AssetAnalysis& asset = report_.assets[i];
      ordered_json& node = nodes.emplace_back(ordered_json::object());
      node["name"] = std::filesystem::path(asset.asset).filename().string();
      put_placement(node, upright(asset.up_axis, asset.unit_scale));
      node["extras"] = head["assets"][i];
    }
    for (std::size_t i = 0; i < layout_.instances.size(); ++i)
      nodes[report_.rating.meshes[i].asset]["children"].push_back(nodes.size() + i);
    return nodes;
  }

  ordered_json instance_node(std::size_t index) const {
    const ratings::MeshRating& row = report_.rating.meshes[index];
    const analysis::InstanceAnalysis& instance = report_.assets[row.asset].instances[row.instance];
    const GlbInstance& planned = layout_.instances[index];
    const std::optional<Placement> placement = place(scenes_[row.asset]->instances[row.instance].world);
    ordered_json node = ordered_json::object();
    const std::string& name = instance.node.empty() ? instance.mesh : instance.node;
    if (!name.empty()) node["name"] = name;
    if (placement) put_placement(node, *placement);
    if (planned.mesh) node["mesh"] = *planned.mesh;
    ordered_json& extras = node["extras"] = mesh_row(report_, index);
    if (planned.left_out > 0) {
      extras["left_out_triangles"] = planned.left_out;
      extras["left_out_because"] = placement ? "a corner is not finite in 32-bit floats"
                                             : "the node's matrix is not finite in 32-bit floats";
    }
    return node;
  }

  ordered_json mesh(std::size_t index) const {
    const GlbMesh& mesh = layout_.meshes[index];
    const GlbGeometry& geometry = layout_.geometries[mesh.geometry];
    ordered_json result = ordered_json::object();
    if (!geometry.mesh->name.empty()) result["name"] = geometry.mesh->name;
    result["primitives"] = {{{"attributes", {{"POSITION", geometry.positions}, {"COLOR_0", mesh.colors}}},
                             {"indices", geometry.indices},
                             {"material", 0}}};
    return result;
  }

  static ordered_json material() {
    return {{"name", "rating"},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {1, 1, 1, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
            {"doubleSided", true}};
  }

  ordered_json accessor(std::size_t index) const {
    const GlbAccessor& accessor = layout_.accessors[index];
    const GlbView& view = layout_.views[accessor.view];
    const GlbGeometry& geometry = layout_.geometries[view.geometry];
    ordered_json result = {{"bufferView", accessor.view}};
    switch (view.kind) {
      case GlbView::Kind::kPositions:
        result.update({{"componentType", kFloat}, {"count", accessor.count}, {"type", "VEC3"}});
        result["min"] = geometry.min;
        result["max"] = geometry.max;
        break;
      case GlbView::Kind::kIndices:
        result["componentType"] = has_short_indices(geometry) ? kUnsignedShort : kUnsignedInt;
        result.update({{"count", accessor.count}, {"type", "SCALAR"}});
        break;
      case GlbView::Kind::kColors:
        result.update({{"componentType", kUnsignedShort}, {"normalized", true}});
        result.update({{"count", accessor.count}, {"type", "VEC4"}});
        break;
    }
    return result;
  }

  ordered_json view(std::size_t index) const {
    const GlbView& view = layout_.views[index];
    ordered_json result = {{"buffer", 0}, {"byteOffset", view.offset}, {"byteLength", view.bytes}};
    if (view.kind == GlbView::Kind::kColors) result["byteStride"] = 8;  // several accessors may share it
    result["target"] = view.kind == GlbView::Kind::kIndices ? kIndexBuffer : kVertexBuffer;
    return result;
  }

  const SceneReport& report_;
  std::span<const mesh::Scene* const> scenes_;
  const GlbLayout& layout_;
};

}  // namespace

void append_document(std::string& out, const SceneReport& report, std::span<const mesh::Scene* const> scenes,
                     const GlbLayout& layout) {
  Document(report, scenes, layout).append_to(out);
}

}  // namespace scene_analyzer::report
