// review_keys.h — What the keys of the review window do. One table is both their behaviour and their help.
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>

#include "viewer/navigation.h"
#include "viewer/review_state.h"

namespace scene_analyzer::viewer {

// By the character that a key types where it types one, whatever the layout of the keyboard. kF1 to kF12
// follow each other.
enum class Key {
  kF1,
  kF2,
  kF3,
  kF4,
  kF5,
  kF6,
  kF7,
  kF8,
  kF9,
  kF10,
  kF11,
  kF12,
  kEscape,
  kHome,
  kArrowLeft,
  kArrowRight,
  kArrowUp,
  kArrowDown,
  kSemicolon,
  kPeriod,
  kPlus,
  kMinus,
  kA,
  kC,
  kD,
  kE,
  kF,
  kP,
  kS,
  kW,
  kX,
};

// What a key asks of the window, beyond what it changes itself.
enum class Command {
  kNone,
  kQuit,
  kWriteRatings,
  kPrintKeys,
  kPictureOfScene,
  kPictureOfWindow,
  kFrameSelected,
  kFrameAll
};

// One row of the table: a key has an effect of exactly one of three kinds.
struct KeyBinding {
  Key key = Key::kF1;
  std::string_view name;  // on the keyboard: "F1", "Left"
  std::string does;       // "Polygons per planar group (R_pppg)", "write all current ratings to a file"
  Command command = Command::kNone;
  Motion motion = {};                                      // while it is held
  void (*change)(ReviewState& state) = nullptr;            // when it is pressed
  std::string (*present)(const ReviewState& s) = nullptr;  // what `change` has led to: "on, weight 1"
};

// All keys that do something, in the order of the help; each once.
std::span<const KeyBinding> key_bindings();

// A key goes down, once however long it is held: changes the state, or says what else is to be done.
Command press(Key key, ReviewState& state);

// What moves while these keys are held. Opposite ones cancel each other; two for the same are no faster.
Motion motion_of(const std::set<Key>& held);

// A line per key: what it does and how that stands now. Ends with a newline.
std::string key_help(const ReviewState& state);

}  // namespace scene_analyzer::viewer
