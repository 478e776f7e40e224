#include "viewer/mouse.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace scene_analyzer::viewer {
namespace {

constexpr float kClickPixels = 4;  // a pointer that moves less has clicked

// Not in the frame that sees it go down: the pointer's way before that is not a drag.
bool is_dragging(ImGuiMouseButton button) {
  return ImGui::IsMouseDown(button) && !ImGui::IsMouseClicked(button);
}

bool has_clicked() {
  const ImVec2 dragged = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0);
  return ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
         std::max(std::abs(dragged.x), std::abs(dragged.y)) < kClickPixels;
}

}  // namespace

std::optional<std::pair<std::uint32_t, std::uint32_t>> follow_mouse(Navigation& navigation) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantCaptureMouse) return std::nullopt;
  const double right = io.MouseDelta.x / io.DisplaySize.y, down = io.MouseDelta.y / io.DisplaySize.y;
  if (is_dragging(ImGuiMouseButton_Left)) navigation.orbit(right, down);
  if (is_dragging(ImGuiMouseButton_Right) || is_dragging(ImGuiMouseButton_Middle))
    navigation.pan(right, down);
  if (io.MouseWheel != 0) navigation.zoom(io.MouseWheel);
  const ImVec2 place = io.MouseClickedPos[ImGuiMouseButton_Left];  // where it went down
  if (!has_clicked() || place.x < 0 || place.y < 0) return std::nullopt;
  return std::pair{static_cast<std::uint32_t>(place.x * io.DisplayFramebufferScale.x),
                   static_cast<std::uint32_t>(place.y * io.DisplayFramebufferScale.y)};
}

}  // namespace scene_analyzer::viewer
