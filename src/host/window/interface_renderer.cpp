#include "window/interface_renderer.h"

#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <vector>

#include "interface/user_interface.h"
// Generated:
#include "user_interface_frag.spv.h"
#include "user_interface_vert.spv.h"

namespace scene_analyzer::window {
namespace {

using interface::user_interface::InterfaceDrawParams;

constexpr gpu::VertexFormat kInputs[] = {gpu::VertexFormat::kFloat2, gpu::VertexFormat::kFloat2,
                                         gpu::VertexFormat::kUnorm8x4};
constexpr float kTextPixels = 15;  // at scale 1

// Vertices of all lists, one array per location, and indices of 32 bits.
struct Arrays {
  std::vector<float> positions, texture_positions;
  std::vector<std::uint32_t> colors, indices;
};

Arrays arrays_of(const ImDrawData& data) {
  Arrays arrays;
  for (const ImDrawList* list : std::span(data.CmdLists, static_cast<std::size_t>(data.CmdListsCount))) {
    for (const ImDrawVert& vertex : list->VtxBuffer) {
      arrays.positions.insert(arrays.positions.end(), {vertex.pos.x, vertex.pos.y});
      arrays.texture_positions.insert(arrays.texture_positions.end(), {vertex.uv.x, vertex.uv.y});
      arrays.colors.push_back(vertex.col);
    }
    arrays.indices.insert(arrays.indices.end(), list->IdxBuffer.begin(), list->IdxBuffer.end());
  }
  return arrays;
}

// In pixels, within the target; empty ones are left out.
std::optional<std::array<std::uint32_t, 4>> clip_of(const ImVec4& rectangle, const ImVec2& scale,
                                                    const gpu::RenderTarget& target) {
  const auto within = [](float value, std::uint32_t most) {
    return static_cast<std::uint32_t>(std::clamp(value, 0.0F, static_cast<float>(most)));
  };
  const std::uint32_t left = within(rectangle.x * scale.x, target.width()),
                      top = within(rectangle.y * scale.y, target.height()),
                      right = within(rectangle.z * scale.x, target.width()),
                      bottom = within(rectangle.w * scale.y, target.height());
  if (left >= right || top >= bottom) return std::nullopt;
  return std::array{left, top, right - left, bottom - top};
}

}  // namespace

InterfaceRenderer::InterfaceRenderer(gpu::Device& device, const Window& window, std::uint32_t samples)
    : device_(device) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // leaves no file behind
  ImGui::StyleColorsDark();
  ImGui::GetStyle().ScaleAllSizes(window.scale());
  ImFontConfig font;
  font.SizePixels = std::round(kTextPixels * window.scale());
  io.Fonts->AddFontDefault(&font);
  ImGui_ImplGlfw_InitForVulkan(window.handle(), true);
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  font_ = device.make_texture(
      "font", static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
      std::span(pixels, std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)));
  pipeline_ = device.make_raster_pipeline(
      "user interface",
      {.vertex = user_interface_vert_spv,
       .fragment = user_interface_frag_spv,
       .inputs = kInputs,
       .push_constant_bytes = sizeof(InterfaceDrawParams),
       .reads_texture = true,
       .state = {.samples = samples, .reversed_depth = false, .translucent = true, .tests_depth = false}});
}

InterfaceRenderer::~InterfaceRenderer() {
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void InterfaceRenderer::begin_frame() {
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void InterfaceRenderer::grow(std::uint64_t vertices, std::uint64_t indices) {
  if (vertices > vertex_room_) {
    vertex_room_ = std::bit_ceil(vertices);
    positions_ = device_.make_vertex_buffer("interface positions", 8 * vertex_room_);
    texture_positions_ = device_.make_vertex_buffer("interface texture positions", 8 * vertex_room_);
    colors_ = device_.make_vertex_buffer("interface colours", 4 * vertex_room_);
  }
  if (indices > index_room_) {
    index_room_ = std::bit_ceil(indices);
    indices_ = device_.make_vertex_buffer("interface indices", 4 * index_room_);
  }
}

void InterfaceRenderer::record(gpu::Recorder& recorder, const gpu::RenderTarget& target) {
  ImGui::Render();
  const ImDrawData& data = *ImGui::GetDrawData();
  const Arrays arrays = arrays_of(data);
  if (arrays.indices.empty()) return;
  grow(arrays.colors.size(), arrays.indices.size());
  device_.upload(positions_, 0, std::as_bytes(std::span(arrays.positions)));
  device_.upload(texture_positions_, 0, std::as_bytes(std::span(arrays.texture_positions)));
  device_.upload(colors_, 0, std::as_bytes(std::span(arrays.colors)));
  device_.upload(indices_, 0, std::as_bytes(std::span(arrays.indices)));

  const std::array inputs{gpu::BufferRange(positions_), gpu::BufferRange(texture_positions_),
                          gpu::BufferRange(colors_)};
  const InterfaceDrawParams params{.scale = {2 / data.DisplaySize.x, 2 / data.DisplaySize.y}};
  std::uint32_t first_vertex = 0, first_index = 0;
  recorder.begin_rendering(target);
  for (const ImDrawList* list : std::span(data.CmdLists, static_cast<std::size_t>(data.CmdListsCount))) {
    for (const ImDrawCmd& command : list->CmdBuffer) {
      const auto clip = clip_of(command.ClipRect, data.FramebufferScale, target);
      if (clip)
        recorder.draw(pipeline_, params,
                      {.inputs = inputs,
                       .indices = &indices_,
                       .first_index = first_index + command.IdxOffset,
                       .index_count = command.ElemCount,
                       .first_vertex = first_vertex + command.VtxOffset,
                       .texture = &font_,
                       .clip = clip});
    }
    first_vertex += static_cast<std::uint32_t>(list->VtxBuffer.Size);
    first_index += static_cast<std::uint32_t>(list->IdxBuffer.Size);
  }
  recorder.end_rendering();
}

}  // namespace scene_analyzer::window
