#include "viewer/selection_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>

#include "viewer/panel_style.h"

namespace scene_analyzer::viewer {
namespace {

using report::Extremes;

constexpr ImU32 kBracket = IM_COL32(255, 120, 0, 255);
constexpr ImU32 kAreas = IM_COL32(90, 160, 235, 255), kMagnitudes = IM_COL32(235, 130, 90, 255);

// Bands from the least to the greatest of each column, over 0; at least a pixel high, so that equal values
// make a line.
void draw_curve(const std::vector<Extremes>& columns, double least_top, ImU32 color) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = 4 * ImGui::GetTextLineHeight();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + width, corner.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg));
  double top = least_top;
  for (const Extremes& column : columns) top = std::max(top, column.greatest);
  const auto place = [&](double value) {
    return corner.y + height * static_cast<float>(1 - (top > 0 ? value / (1.05 * top) : 0));
  };
  const float step = width / static_cast<float>(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const float left = corner.x + step * static_cast<float>(i), upper = place(columns[i].greatest);
    list.AddRectFilled({left, upper}, {left + step, std::max(place(columns[i].least), upper + 1)}, color);
  }
  ImGui::Dummy({width, height});
}

void draw_curves(const SignalCurves& curves, double area_scale) {
  ImGui::TextWrapped("Signal: areas of %s triangles, by distance along the surface",
                     fmt::format("{}", curves.length).c_str());
  draw_curve(curves.areas, 0, kAreas);
  if (curves.magnitudes.empty()) return;
  ImGui::TextWrapped("Spectrum: largest |X_k| = %s at k = %s",
                     fmt::format("{:.4g}", curves.largest_magnitude * area_scale).c_str(),
                     fmt::format("{}", curves.largest_at).c_str());
  // Rounding leaves tiny magnitudes where all areas are equal; they are to look like nothing.
  double greatest = 0;
  for (const Extremes& column : curves.areas) greatest = std::max(greatest, column.greatest);
  draw_curve(curves.magnitudes, 1e-9 * greatest * static_cast<double>(curves.length), kMagnitudes);
}

void draw_signal(const ReviewedScene& scene, std::size_t row, const SignalJob::State& signal) {
  if (!ImGui::CollapsingHeader("signal of the Fourier rating", ImGuiTreeNodeFlags_DefaultOpen)) return;
  const analysis::GeometryAnalysis& geometry = scene.geometry(row);
  const auto wanted = signal_of(scene, row);
  if (!geometry.no_fourier_transform.empty())
    ImGui::TextWrapped("%s", geometry.no_fourier_transform.c_str());
  else if (!geometry.signal)
    ImGui::TextUnformatted("it was not measured");
  else if (!wanted)
    ImGui::TextUnformatted("no triangle has a neighbour");
  else if (signal.wanted != wanted || (!signal.curves && signal.error.empty()))
    ImGui::TextUnformatted("is being measured ...");
  else if (!signal.error.empty())
    ImGui::TextWrapped("%s", signal.error.c_str());
  else
    draw_curves(*signal.curves, scene.instance(row).area_scale);
}

// Corners of a rectangle around what the box covers in the window.
void draw_brackets(const analysis::Bounds& box, const scene_render::Camera& camera) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImVec2 low = size, high = {0, 0};
  for (unsigned number = 0; number < 8; ++number) {
    mesh::Vector3 corner = box.min;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if ((number >> axis & 1) != 0) corner[axis] = box.max[axis];
    const auto place = scene_render::project(camera, static_cast<double>(size.x) / size.y, corner);
    if (!place) return;  // it reaches behind the eye: whoever is that near needs no mark
    const auto x = static_cast<float>((1 + place->x) / 2 * size.x);
    const auto y = static_cast<float>((1 - place->y) / 2 * size.y);
    low = {std::min(low.x, x), std::min(low.y, y)};
    high = {std::max(high.x, x), std::max(high.y, y)};
  }
  constexpr float kGap = 4, kLeast = 6, kThickness = 2;
  low = {low.x - kGap, low.y - kGap};
  high = {high.x + kGap, high.y + kGap};
  const float arm = std::max(kLeast, std::min(high.x - low.x, high.y - low.y) / 4);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const bool right : {false, true})
    for (const bool bottom : {false, true}) {
      const ImVec2 corner = {right ? high.x : low.x, bottom ? high.y : low.y};
      list.AddLine(corner, {corner.x + (right ? -arm : arm), corner.y}, kBracket, kThickness);
      list.AddLine(corner, {corner.x, corner.y + (bottom ? -arm : arm)}, kBracket, kThickness);
    }
}

void draw_numbers(const ReviewedScene& scene, std::size_t row) {
  const analysis::GeometryAnalysis& geometry = scene.geometry(row);
  const ratings::MeshRating& mesh = scene.rating().meshes[row];
  const auto line = [](const char* name, const std::string& value) {
    ImGui::Text("%-28s %s", name, value.c_str());
  };
  line("triangles", std::to_string(geometry.triangles));
  if (geometry.planar_groups) line("planar groups", std::to_string(*geometry.planar_groups));
  if (geometry.components) line("connected parts", std::to_string(*geometry.components));
  line("surface area", fmt::format("{:.6g}", mesh.surface_area));
  for (std::size_t i = 0; i < analysis::kMetricCount; ++i)
    line(std::string(analysis::kMetricNames[i]).c_str(), number_or_dash(mesh.ratings[i]));
  line("aggregate", number_or_dash(mesh.aggregate));
}

}  // namespace

std::optional<SignalJob::Wanted> signal_of(const ReviewedScene& scene, std::size_t row) {
  const analysis::GeometryAnalysis& geometry = scene.geometry(row);
  if (!geometry.signal || geometry.signal->length == 0) return std::nullopt;
  return SignalJob::Wanted{scene.rating().meshes[row].asset, scene.instance(row).geometry};
}

void draw_selected(const ReviewedScene& scene, std::size_t row, const SignalJob::State& signal,
                   const scene_render::Camera& camera) {
  if (const auto& bounds = scene.instance(row).bounds) draw_brackets(*bounds, camera);
  const float width = panel_width();
  ImGui::SetNextWindowPos({ImGui::GetIO().DisplaySize.x - width, 0});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, ImGui::GetIO().DisplaySize.y});
  ImGui::SetNextWindowBgAlpha(kPanelOpacity);
  if (ImGui::Begin("selected", nullptr, kPanelFlags | ImGuiWindowFlags_AlwaysAutoResize)) {
    ImGui::TextWrapped("%s", scene.name(row).c_str());
    ImGui::Separator();
    draw_numbers(scene, row);
    draw_signal(scene, row, signal);
  }
  ImGui::End();
}

}  // namespace scene_analyzer::viewer
