// panel_style.h — What the window's panels have in common.
#pragma once

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>

namespace scene_analyzer::viewer {

inline constexpr float kPanelOpacity = 0.85F;
inline constexpr ImGuiWindowFlags kPanelFlags = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                                ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoNavInputs;

// For some 40 letters a line, at most half of the window. In the desktop's units.
inline float panel_width() {
  return std::min(22 * ImGui::GetFontSize(), ImGui::GetIO().DisplaySize.x / 2);
}

// A rating, or what stands for none.
inline std::string number_or_dash(const std::optional<double>& value) {
  return value ? fmt::format("{:.4f}", *value) : "-";
}

}  // namespace scene_analyzer::viewer
