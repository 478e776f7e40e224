#include "scene_render/scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

// Generated:
#include "scene_groups_frag.spv.h"
#include "scene_mesh_frag.spv.h"
#include "scene_mesh_vert.spv.h"

namespace scene_analyzer::scene_render {
namespace {

using interface::scene_render::SceneDrawParams;
using ratings::Rgb;

constexpr gpu::VertexFormat kInputs[] = {gpu::VertexFormat::kFloat3, gpu::VertexFormat::kUint1,
                                         gpu::VertexFormat::kUnorm16x2};
constexpr Rgb kNoColorGrey = {0.8, 0.8, 0.8}, kEdgeInk = {0, 0, 0};
constexpr double kEdgeOpacity = 0.6, kRoomyTriangle = 6;  // pixels, from which on edges have it
// In distances from eye to target. Depths lose nothing by it, see scene_mesh.vert.
constexpr double kNearest = 1e-7;
// The normal 0, and the texture's first corner.
constexpr std::array<std::uint32_t, 1> kNoAttribute = {512u | 512u << 10 | 512u << 20};

std::uint32_t pack(const Rgb& color, double alpha) {
  std::uint32_t packed = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double channel = std::clamp(i < 3 ? color[i] : alpha, 0.0, 1.0);
    packed |= static_cast<std::uint32_t>(std::lround(255 * channel)) << (8 * i);
  }
  return packed;
}

// view * world * (radius, center): of the positions as they lie on the device.
std::array<double, 12> view_from_mesh(const std::array<double, 12>& view, const mesh::Matrix4& world,
                                      const mesh::Vector3& center, double radius) {
  std::array<double, 12> product{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = column == 3 ? view[4 * row + 3] : 0;
      for (std::size_t i = 0; i < 3; ++i) {
        double moved = world[4 * i + column];
        if (column == 3)
          for (std::size_t k = 0; k < 3; ++k) moved += world[4 * i + k] * center[k];
        sum += view[4 * row + i] * moved;
      }
      product[4 * row + column] = column == 3 ? sum : radius * sum;
    }
  return product;
}

// What a picture can show: meshes at infinity have no place in it.
bool is_finite(const std::array<double, 12>& matrix) {
  return std::all_of(matrix.begin(), matrix.end(),
                     [](double entry) { return std::isfinite(static_cast<float>(entry)); });
}

std::uint32_t flags_of(const SceneModel& model, std::size_t index, Look::Fill fill) {
  using namespace interface::scene_render;
  std::uint32_t flags = model.instance(index).texture ? kTextured : 0;
  if (fill == Look::Fill::kColor && model.has_own_color(index)) flags |= kMixLuminance;
  if (fill == Look::Fill::kOwnColor && model.has_own_color(index)) flags |= kOwnColor;
  if (fill == Look::Fill::kNoValue) flags |= kHatched;
  if (fill == Look::Fill::kUnlitColor) flags |= kUnlit;
  return flags;
}

Rgb color_of(const Look& look, Look::Fill fill) {
  if (fill == Look::Fill::kColor || fill == Look::Fill::kUnlitColor) return look.color;
  return fill == Look::Fill::kNoValue ? kNoValueGrey : kNoColorGrey;
}

// Squared, in the view: of the middle of the mesh.
double distance_of(const std::array<double, 12>& matrix) {
  return matrix[3] * matrix[3] + matrix[7] * matrix[7] + matrix[11] * matrix[11];
}

// About how many pixels the mesh covers, where it is small or in full view.
double pixels_of(const std::array<double, 12>& matrix, const Camera& camera, std::uint32_t height) {
  double across = 0;  // mean half extent along the mesh's own axes, in the view
  for (std::size_t column = 0; column < 3; ++column)
    across += std::hypot(matrix[column], matrix[4 + column], matrix[8 + column]) / 3;
  const double radius =
      across / std::max(std::sqrt(distance_of(matrix)), kNearest) / camera.tangent * height / 2;
  return std::numbers::pi * radius * radius;
}

}  // namespace

SceneRenderer::SceneRenderer(gpu::Device& device, std::uint32_t samples)
    : device_(device),
      samples_(samples),
      opaque_(make_pipelines(false)),
      translucent_(make_pipelines(true)),
      group_colors_(device, "colours of planar groups", 256) {
  constexpr std::array<std::uint8_t, 4> kWhite = {255, 255, 255, 255};
  white_ = device.make_texture("white", 1, 1, kWhite);
  no_attribute_ = device.make_vertex_buffer("no attribute", sizeof kNoAttribute);
  device.upload(no_attribute_, 0, std::as_bytes(std::span(kNoAttribute)));
  set_group_colors(ratings::ColorMap::kThesis);
}

SceneRenderer::Pipelines SceneRenderer::make_pipelines(bool translucent) {
  const gpu::RasterState state{.samples = samples_, .reversed_depth = true, .translucent = translucent};
  const gpu::RasterShaders meshes{.vertex = scene_mesh_vert_spv,
                                  .fragment = scene_mesh_frag_spv,
                                  .inputs = kInputs,
                                  .push_constant_bytes = sizeof(SceneDrawParams),
                                  .reads_texture = true,
                                  .state = state};
  Pipelines pipelines;
  pipelines.meshes = device_.make_raster_pipeline("scene", meshes);
  if (can_draw_edges()) {
    gpu::RasterShaders edges = meshes;
    edges.state.wireframe = true;
    pipelines.edges = device_.make_raster_pipeline("edges", edges);
  }
  if (can_draw_groups()) {
    gpu::RasterShaders groups = meshes;
    groups.fragment = scene_groups_frag_spv;
    groups.reads_texture = false;
    groups.buffer_count = 2;
    pipelines.groups = device_.make_raster_pipeline("planar groups", groups);
  }
  return pipelines;
}

void SceneRenderer::set_group_colors(ratings::ColorMap map) {
  std::vector<std::uint32_t> colors(256);
  for (std::size_t i = 0; i < colors.size(); ++i)
    colors[i] = pack(ratings::color(static_cast<double>(i) / 255, map), 1);
  group_colors_.upload(device_, colors);
}

void SceneRenderer::record_instance(gpu::Recorder& recorder, const SceneModel& model, std::size_t index,
                                    const Look& look, const Camera& camera,
                                    const gpu::RenderTarget& target) const {
  const SceneModel::Instance& instance = model.instance(index);
  const SceneModel::Slot& slot = model.slots_[instance.mesh];
  const bool groups = look.fill == Look::Fill::kGroups && instance.groups && can_draw_groups();
  const Look::Fill fill = look.fill == Look::Fill::kGroups && !groups ? Look::Fill::kNoValue : look.fill;
  const auto matrix = view_from_mesh(view_matrix(camera), instance.world, slot.center, slot.radius);
  SceneDrawParams params{};
  std::transform(matrix.begin(), matrix.end(), params.view_from_mesh.begin(),
                 [](double entry) { return static_cast<float>(entry); });
  const double aspect = static_cast<double>(target.width()) / target.height();
  params.projection = {static_cast<float>(1 / (camera.tangent * aspect)),
                       static_cast<float>(1 / camera.tangent), static_cast<float>(kNearest),
                       static_cast<float>(camera.middle[0]), static_cast<float>(camera.middle[1])};
  // v goes up in files, and down in the rows of a texture.
  params.texture_position = {
      static_cast<float>(slot.texture_range[0]), static_cast<float>(-slot.texture_range[1]),
      static_cast<float>(slot.texture_low[0]), static_cast<float>(1 - slot.texture_low[1])};
  params.color = pack(color_of(look, fill), look.opacity);
  const auto own = instance.own_color.value_or(std::array{1.0F, 1.0F, 1.0F, 1.0F});
  params.own_color = pack({own[0], own[1], own[2]}, 1);
  params.flags = flags_of(model, index, fill);

  const gpu::Buffer& page = model.pages_[slot.page];
  const auto part = [&](const std::optional<std::uint64_t>& offset) {
    return offset ? gpu::BufferRange(page, *offset, 0) : gpu::BufferRange(no_attribute_);
  };
  const std::array inputs{gpu::BufferRange(page, slot.positions, 0), part(slot.normals),
                          part(slot.texture_positions)};
  gpu::Recorder::Draw draw{.inputs = inputs,
                           .indices = slot.first_index ? &page : nullptr,
                           .first_index = slot.first_index.value_or(0),
                           .index_count = slot.corners,
                           .single_inputs = (slot.normals ? 0u : 2u) | (slot.texture_positions ? 0u : 4u)};
  const Pipelines& pipelines = look.opacity < 1 ? translucent_ : opaque_;
  if (groups) {
    const SceneModel::GroupSlot& group_slot = model.group_slots_[*instance.groups];
    params.first_value = group_slot.first;
    const std::array buffers{gpu::BufferRange(model.group_pages_[group_slot.page]),
                             gpu::BufferRange(group_colors_)};
    draw.buffers = buffers;
    recorder.draw(pipelines.groups, params, draw);
    draw.buffers = {};
  } else {
    draw.texture = instance.texture ? &model.textures_[*instance.texture] : &white_;
    recorder.draw(pipelines.meshes, params, draw);
  }
  if (!look.edges || !can_draw_edges()) return;
  const double pixels = pixels_of(matrix, camera, target.height());
  record_edges(recorder, draw, params, pixels / (slot.corners / 3.0));
}

void SceneRenderer::record_edges(gpu::Recorder& recorder, gpu::Recorder::Draw draw, SceneDrawParams params,
                                 double pixels_per_triangle) const {
  draw.texture = &white_;
  // Where triangles are smaller than their edges, these would hide everything.
  params.color = pack(kEdgeInk, kEdgeOpacity * std::clamp(pixels_per_triangle / kRoomyTriangle, 0.01, 1.0));
  params.flags = interface::scene_render::kUnlit;
  recorder.draw(translucent_.edges, params, draw);
}

void SceneRenderer::record(gpu::Recorder& recorder, const gpu::RenderTarget& target, const SceneModel& model,
                           const Camera& camera, std::span<const Look> looks) const {
  const std::array<double, 12> view = view_matrix(camera);
  std::vector<std::size_t> opaque;
  std::vector<std::pair<double, std::size_t>> translucent;  // minus the distance: the farthest first
  for (std::size_t i = 0; i < model.size(); ++i) {
    const SceneModel::Slot& slot = model.slots_[model.instance(i).mesh];
    const auto matrix = view_from_mesh(view, model.instance(i).world, slot.center, slot.radius);
    if (slot.corners == 0 || !is_finite(matrix)) continue;
    if (looks[i].opacity < 1)
      translucent.emplace_back(-distance_of(matrix), i);
    else
      opaque.push_back(i);
  }
  std::sort(translucent.begin(), translucent.end());
  recorder.clear(target, kBackground, 0);
  recorder.begin_rendering(target);
  for (const std::size_t i : opaque) record_instance(recorder, model, i, looks[i], camera, target);
  for (const auto& [distance, i] : translucent) record_instance(recorder, model, i, looks[i], camera, target);
  recorder.end_rendering();
}

Picture SceneRenderer::draw(const SceneModel& model, const Camera& camera, std::span<const Look> looks,
                            std::uint32_t width, std::uint32_t height) {
  const gpu::RenderTarget target = device_.make_render_target("scene", width, height, samples_);
  gpu::Recorder recorder(device_);
  record(recorder, target, model, camera, looks);
  recorder.submit_and_wait();
  return read_picture(device_, target);
}

}  // namespace scene_analyzer::scene_render
