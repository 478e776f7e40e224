#include "viewer/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "pictures/legend.h"
#include "viewer/panel_style.h"

namespace scene_analyzer::viewer {
namespace {

constexpr int kNameColumn = 0, kTrianglesColumn = 1, kAggregateColumn = 2, kFirstMetricColumn = 3;
constexpr std::size_t kMostMessages = 4;

// What one column of one row holds, for sorting; absent values come last.
std::optional<double> sort_value(const ReviewedScene& scene, std::size_t row, int column) {
  const ratings::MeshRating& mesh = scene.rating().meshes[row];
  if (column == kTrianglesColumn) return static_cast<double>(scene.geometry(row).triangles);
  if (column == kAggregateColumn) return mesh.aggregate;
  return mesh.ratings[static_cast<std::size_t>(column - kFirstMetricColumn)];
}

void draw_legend(const ReviewedScene& scene, const ReviewState& state) {
  const pictures::Legend legend = pictures::make_legend(content_of(state), scene.rating(), "scene");
  ImGui::TextUnformatted(legend.title.c_str());
  if (!legend.bar) return;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    const ratings::Rgb color = legend.bar((i + 0.5) / kSteps);
    ImGui::GetWindowDrawList()->AddRectFilled(
        {corner.x + width * static_cast<float>(i) / kSteps, corner.y},
        {corner.x + width * static_cast<float>(i + 1) / kSteps, corner.y + height},
        ImGui::GetColorU32(
            {static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2]), 1}));
  }
  ImGui::Dummy({width, height});
  if (legend.ticks.empty()) return;
  const char *first = legend.ticks.front().second.c_str(), *last = legend.ticks.back().second.c_str();
  ImGui::TextUnformatted(first);
  const float last_width = ImGui::CalcTextSize(last).x;
  // Side by side where there is room, else one below the other.
  const float place = std::max(0.0F, ImGui::GetWindowContentRegionMax().x - last_width);
  if (ImGui::CalcTextSize(first).x + last_width + ImGui::GetFontSize() < width) ImGui::SameLine(place);
  ImGui::SetCursorPosX(place);
  ImGui::TextUnformatted(last);
  for (const std::string& line : legend.lines) ImGui::TextWrapped("%s", line.c_str());
}

void draw_status(const Status& status) {
  if (status.analysing) {
    const ReviewJob::Progress& job = status.job;
    ImGui::TextWrapped("%s: %s", job.name.c_str(), job.step.c_str());
    const std::string text = fmt::format("{} of {}", std::min(job.asset + 1, job.assets), job.assets);
    const double done =
        job.assets == 0 ? 0
                        : (static_cast<double>(job.asset) + job.fraction) / static_cast<double>(job.assets);
    ImGui::ProgressBar(static_cast<float>(done), {-1, 0}, text.c_str());
  }
  ImGui::Text("%.1f ms per frame", status.frame_milliseconds);
  const std::size_t first = status.messages.size() - std::min(status.messages.size(), kMostMessages);
  for (std::size_t i = first; i < status.messages.size(); ++i)
    ImGui::TextWrapped("%s", status.messages[i].c_str());
}

void draw_map_choice(ReviewState& state) {
  using ratings::ColorMap;
  if (!ImGui::BeginCombo("map (c)", name_of(state.map))) return;
  for (const ColorMap map : {ColorMap::kThesis, ColorMap::kViridis, ColorMap::kCividis, ColorMap::kCoolwarm})
    if (ImGui::Selectable(name_of(map), map == state.map)) state.map = map;
  ImGui::EndCombo();
}

}  // namespace

bool Panels::draw(const ReviewedScene& scene, ReviewState& state, const Status& status) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float width = panel_width();
  share_ = size.x > 0 ? width / size.x : 0;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize({width, size.y});
  ImGui::SetNextWindowBgAlpha(kPanelOpacity);
  bool show_selected = false;
  if (ImGui::Begin("review", nullptr, kPanelFlags)) {
    draw_status(status);
    if (scene.is_ready()) {
      draw_metrics(scene, state, status);
      ImGui::Separator();
      show_selected = draw_table(scene, state);
    }
  }
  ImGui::End();
  return show_selected;
}

void Panels::draw_metrics(const ReviewedScene& scene, ReviewState& state, const Status& status) {
  draw_legend(scene, state);
  ImGui::Separator();
  for (std::size_t i = 0; i < analysis::kMetricCount; ++i) {
    ImGui::PushID(static_cast<int>(i));
    ImGui::BeginDisabled(!state.computed[i]);
    bool on = state.active[i];
    if (ImGui::Checkbox(fmt::format("F{} {}", i + 1, analysis::kMetricSymbols[i]).c_str(), &on))
      toggle(state, static_cast<analysis::Metric>(i));
    ImGui::SameLine(ImGui::GetFontSize() * 8);
    ImGui::SetNextItemWidth(-1);
    auto weight = static_cast<float>(state.weights[i]);
    if (ImGui::SliderFloat("##weight", &weight, 0, static_cast<float>(kGreatestWeight), "weight %.2f"))
      state.weights[i] = weight;
    ImGui::EndDisabled();
    ImGui::PopID();
  }
  ImGui::BeginDisabled(!status.groups_can_be_drawn);
  ImGui::Checkbox("planar groups (F10)", &state.planar_groups);
  ImGui::EndDisabled();
  ImGui::Checkbox("relative (F11)", &state.relative);
  ImGui::Checkbox("extreme meshes only (e)", &state.emphasize_extremes);
  ImGui::BeginDisabled(!status.edges_can_be_drawn);
  ImGui::Checkbox("edges (x)", &state.wireframe);
  ImGui::EndDisabled();
  draw_map_choice(state);
}

void Panels::sort_rows(const ReviewedScene& scene) {
  rows_.resize(scene.rating().meshes.size());
  std::iota(rows_.begin(), rows_.end(), std::size_t{0});
  if (sorted_by_ == kNameColumn) {
    std::ranges::stable_sort(rows_, [&](std::size_t a, std::size_t b) {
      return ascending_ ? scene.name(a) < scene.name(b) : scene.name(b) < scene.name(a);
    });
    return;
  }
  std::ranges::stable_sort(rows_, [&](std::size_t a, std::size_t b) {
    const auto left = sort_value(scene, a, sorted_by_), right = sort_value(scene, b, sorted_by_);
    if (!left || !right) return left.has_value() && !right.has_value();
    return ascending_ ? *left < *right : *right < *left;
  });
}

bool Panels::draw_table(const ReviewedScene& scene, ReviewState& state) {
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollX |
                                     ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg |
                                     ImGuiTableFlags_Resizable;
  if (!ImGui::BeginTable("meshes", kFirstMetricColumn + static_cast<int>(analysis::kMetricCount), kFlags))
    return false;
  ImGui::TableSetupScrollFreeze(1, 1);
  ImGui::TableSetupColumn("mesh", ImGuiTableColumnFlags_WidthFixed, 10 * ImGui::GetFontSize());
  ImGui::TableSetupColumn("triangles", ImGuiTableColumnFlags_PreferSortDescending);
  ImGui::TableSetupColumn("R",
                          ImGuiTableColumnFlags_PreferSortDescending | ImGuiTableColumnFlags_DefaultSort);
  for (const std::string_view symbol : analysis::kMetricSymbols)
    ImGui::TableSetupColumn(std::string(symbol).c_str(), ImGuiTableColumnFlags_PreferSortDescending);
  ImGui::TableHeadersRow();
  if (const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
      specs != nullptr && specs->SpecsCount > 0) {
    sorted_by_ = specs->Specs[0].ColumnIndex;
    ascending_ = specs->Specs[0].SortDirection == ImGuiSortDirection_Ascending;
  }
  sort_rows(scene);
  bool show_selected = false;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(rows_.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const std::size_t row = rows_[static_cast<std::size_t>(i)];
      const ratings::MeshRating& mesh = scene.rating().meshes[row];
      ImGui::PushID(static_cast<int>(row));
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      if (ImGui::Selectable(scene.name(row).c_str(), state.selected == row,
                            ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
        state.selected = row;
        show_selected = show_selected || ImGui::IsMouseDoubleClicked(0);
      }
      ImGui::TableNextColumn();
      ImGui::Text("%s", std::to_string(scene.geometry(row).triangles).c_str());
      ImGui::TableNextColumn();
      ImGui::Text("%s", number_or_dash(mesh.aggregate).c_str());
      for (const std::optional<double>& rating : mesh.ratings) {
        ImGui::TableNextColumn();
        ImGui::Text("%s", number_or_dash(rating).c_str());
      }
      ImGui::PopID();
    }
  ImGui::EndTable();
  return show_selected;
}

}  // namespace scene_analyzer::viewer
