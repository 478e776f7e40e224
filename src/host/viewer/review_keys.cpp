#include "viewer/review_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace scene_analyzer::viewer {
namespace {

std::string on_or_off(bool on) {
  return on ? "on" : "off";
}

template <std::size_t metric>
KeyBinding metric_key() {
  static constexpr std::string_view kNames[] = {"F1", "F2", "F3", "F4", "F5", "F6", "F7"};
  return {.key = static_cast<Key>(static_cast<std::size_t>(Key::kF1) + metric),
          .name = kNames[metric],
          .does = fmt::format("{} ({})", analysis::kMetricNames[metric], analysis::kMetricSymbols[metric]),
          .change = [](ReviewState& state) { toggle(state, static_cast<analysis::Metric>(metric)); },
          .present = [](const ReviewState& state) -> std::string {
            if (!state.computed[metric]) return "not computed";
            return fmt::format("{}, weight {:.3g}", on_or_off(state.active[metric]), state.weights[metric]);
          }};
}

template <std::size_t... metrics>
void add_metric_keys(std::vector<KeyBinding>& table, std::index_sequence<metrics...>) {
  (table.push_back(metric_key<metrics>()), ...);
}

// A key that switches one member.
template <bool ReviewState::*member>
KeyBinding switch_key(Key key, std::string_view name, const char* does) {
  return {.key = key,
          .name = name,
          .does = does,
          .change = [](ReviewState& state) { state.*member = !(state.*member); },
          .present = [](const ReviewState& state) { return on_or_off(state.*member); }};
}

void next_map(ReviewState& state) {
  const auto following = static_cast<int>(state.map) + 1;
  state.map = following > static_cast<int>(ratings::ColorMap::kCoolwarm)
                  ? ratings::ColorMap::kThesis
                  : static_cast<ratings::ColorMap>(following);
}

KeyBinding command_key(Key key, std::string_view name, const char* does, Command command) {
  return {.key = key, .name = name, .does = does, .command = command};
}

KeyBinding motion_key(Key key, std::string_view name, const char* does, const Motion& motion) {
  return {.key = key, .name = name, .does = does, .motion = motion};
}

void add_switches(std::vector<KeyBinding>& table) {
  table.push_back(switch_key<&ReviewState::planar_groups>(Key::kF10, "F10", "planar groups"));
  KeyBinding relative = switch_key<&ReviewState::relative>(Key::kF11, "F11", "absolute or relative ratings");
  relative.present = [](const ReviewState& state) -> std::string {
    return state.relative ? "relative" : "absolute";
  };
  table.push_back(std::move(relative));
  table.push_back(switch_key<&ReviewState::emphasize_extremes>(Key::kE, "e", "extreme meshes only"));
  table.push_back(switch_key<&ReviewState::wireframe>(Key::kX, "x", "edges of triangles"));
  table.push_back({.key = Key::kC,
                   .name = "c",
                   .does = "next colour map",
                   .change = next_map,
                   .present = [](const ReviewState& state) -> std::string { return name_of(state.map); }});
}

void add_motions(std::vector<KeyBinding>& table) {
  const auto add = [&](Key key, std::string_view name, const char* does, const Motion& motion) {
    table.push_back(motion_key(key, name, does, motion));
  };
  add(Key::kArrowLeft, "Left", "move to the left", {.right = -1});
  add(Key::kArrowRight, "Right", "move to the right", {.right = 1});
  add(Key::kArrowUp, "Up", "move forward", {.forward = 1});
  add(Key::kArrowDown, "Down", "move back", {.forward = -1});
  add(Key::kSemicolon, ";", "move up", {.up = 1});
  add(Key::kPeriod, ".", "move down", {.up = -1});
  add(Key::kA, "a", "move to the left", {.right = -1});
  add(Key::kD, "d", "move to the right", {.right = 1});
  add(Key::kW, "w", "move forward", {.forward = 1});
  add(Key::kS, "s", "move back", {.forward = -1});
  add(Key::kPlus, "+", "scale the scene up", {.scale = 1});
  add(Key::kMinus, "-", "scale the scene down", {.scale = -1});
}

void add_commands(std::vector<KeyBinding>& table) {
  const auto add = [&](Key key, std::string_view name, const char* does, Command command) {
    table.push_back(command_key(key, name, does, command));
  };
  add(Key::kHome, "Home", "show the whole scene", Command::kFrameAll);
  add(Key::kF, "f", "show the selected mesh", Command::kFrameSelected);
  add(Key::kP, "p", "write all current ratings to a file", Command::kWriteRatings);
  add(Key::kF8, "F8", "write the window, panels included, to a file", Command::kPictureOfWindow);
  add(Key::kF9, "F9", "write the scene as a picture with a legend", Command::kPictureOfScene);
  add(Key::kF12, "F12", "print this list", Command::kPrintKeys);
  add(Key::kEscape, "Esc", "quit", Command::kQuit);
}

std::vector<KeyBinding> make_table() {
  std::vector<KeyBinding> table;
  add_metric_keys(table, std::make_index_sequence<analysis::kMetricCount>());
  add_switches(table);
  add_motions(table);
  add_commands(table);
  return table;
}

}  // namespace

std::span<const KeyBinding> key_bindings() {
  static const std::vector<KeyBinding> table = make_table();
  return table;
}

Command press(Key key, ReviewState& state) {
  const auto binding = std::ranges::find(key_bindings(), key, &KeyBinding::key);
  if (binding == key_bindings().end()) return Command::kNone;
  if (binding->change != nullptr) binding->change(state);
  return binding->command;
}

Motion motion_of(const std::set<Key>& held) {
  Motion motion;
  // Per direction, so that one key against two of the other side stands still, too.
  for (double Motion::*part : {&Motion::right, &Motion::up, &Motion::forward, &Motion::scale}) {
    bool more = false, less = false;
    for (const KeyBinding& binding : key_bindings()) {
      if (!held.contains(binding.key)) continue;
      more = more || binding.motion.*part > 0;
      less = less || binding.motion.*part < 0;
    }
    motion.*part = (more ? 1 : 0) - (less ? 1 : 0);
  }
  return motion;
}

std::string key_help(const ReviewState& state) {
  std::string help = fmt::format("Keys (shown now: {}):\n", describe(state));
  for (const KeyBinding& binding : key_bindings()) {
    help += fmt::format("  {:<5}  ", binding.name);
    if (binding.present == nullptr)
      help += binding.does;
    else
      help += fmt::format("{:<36}  {}", binding.does, binding.present(state));
    help += '\n';
  }
  return help;
}

}  // namespace scene_analyzer::viewer
