// The table of keys: every entry does something, and the help knows all of them.
#include "viewer/review_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace scene_analyzer::viewer {
namespace {

using analysis::kMetricCount;
using testing::HasSubstr;

TEST(ReviewKeys, EveryKeyOfTheTableDoesOneThing) {
  std::set<Key> seen;
  std::set<std::string_view> names;
  for (const KeyBinding& binding : key_bindings()) {
    EXPECT_TRUE(seen.insert(binding.key).second) << binding.name;
    EXPECT_TRUE(names.insert(binding.name).second) << binding.name;
    ReviewState state;
    const Command command = press(binding.key, state);
    const int effects = (command != Command::kNone ? 1 : 0) + (state != ReviewState() ? 1 : 0) +
                        (motion_of({binding.key}) != Motion() ? 1 : 0);
    EXPECT_EQ(effects, 1) << binding.name;
    EXPECT_EQ(binding.present != nullptr, state != ReviewState()) << binding.name;
  }
  EXPECT_EQ(seen.size(), 31U);
}

TEST(ReviewKeys, TheHelpNamesEveryKeyAndItsState) {
  for (const KeyBinding& binding : key_bindings()) {
    ReviewState state;
    EXPECT_THAT(key_help(state), HasSubstr("\n  " + std::string(binding.name) + " "));
    EXPECT_THAT(key_help(state), HasSubstr(binding.does));
    if (binding.present == nullptr) continue;
    const std::string before = key_help(state), present = binding.present(state);
    press(binding.key, state);
    EXPECT_NE(binding.present(state), present) << binding.name;
    EXPECT_NE(key_help(state), before) << binding.name;
  }
}

TEST(ReviewKeys, TheHelpHasTheWeights) {
  ReviewState state;
  state.computed.reset(6);
  toggle(state, analysis::Metric::kPlanarGroupVariation);
  state.weights[0] = 2.5;
  const std::string help = key_help(state);
  EXPECT_THAT(help, HasSubstr("Polygons per planar group (R_pppg)    on, weight 2.5\n"));
  EXPECT_THAT(help, HasSubstr("Planar group variation (R_pgv)        off, weight 1\n"));
  EXPECT_THAT(help, HasSubstr("Rendering time (R_rt)                 not computed\n"));
  EXPECT_THAT(help, HasSubstr("shown now: " + describe(state)));
  EXPECT_TRUE(help.ends_with("\n"));
}

TEST(ReviewKeys, FunctionKeysAreTheMetricsInTheirOrder) {
  for (std::size_t i = 0; i < kMetricCount; ++i) {
    ReviewState state;
    const Key key = static_cast<Key>(static_cast<std::size_t>(Key::kF1) + i);
    EXPECT_EQ(press(key, state), Command::kNone);
    EXPECT_EQ(state.active, analysis::MetricSet().set().reset(i));
    press(key, state);
    EXPECT_EQ(state, ReviewState());
    state.computed.reset(i);
    state.active.reset(i);
    const ReviewState before = state;
    press(key, state);
    EXPECT_EQ(state, before) << "not computed";
  }
}

TEST(ReviewKeys, SwitchesAndCommands) {
  ReviewState state;
  press(Key::kF10, state);
  EXPECT_TRUE(state.planar_groups);
  press(Key::kF11, state);
  EXPECT_TRUE(state.relative);
  press(Key::kX, state);
  EXPECT_TRUE(state.wireframe);
  press(Key::kE, state);
  EXPECT_TRUE(state.emphasize_extremes);
  for (const Key key : {Key::kF10, Key::kF11, Key::kX, Key::kE}) press(key, state);
  EXPECT_EQ(state, ReviewState());
  EXPECT_EQ(press(Key::kEscape, state), Command::kQuit);
  EXPECT_EQ(press(Key::kP, state), Command::kWriteRatings);
  EXPECT_EQ(press(Key::kF12, state), Command::kPrintKeys);
  EXPECT_EQ(press(Key::kF8, state), Command::kPictureOfWindow);
  EXPECT_EQ(press(Key::kF9, state), Command::kPictureOfScene);
  EXPECT_EQ(press(Key::kF, state), Command::kFrameSelected);
  EXPECT_EQ(press(Key::kHome, state), Command::kFrameAll);
  EXPECT_EQ(state, ReviewState());
}

TEST(ReviewKeys, ColorMapsGoRound) {
  ReviewState state;
  std::set<ratings::ColorMap> seen;
  for (int i = 0; i < 4; ++i) {
    seen.insert(state.map);
    press(Key::kC, state);
  }
  EXPECT_EQ(seen.size(), 4U);
  EXPECT_EQ(state.map, ratings::ColorMap::kThesis);
}

TEST(ReviewKeys, HeldKeysMove) {
  EXPECT_EQ(motion_of({}), Motion());
  EXPECT_EQ(motion_of({Key::kF1, Key::kEscape, Key::kF8}), Motion());
  EXPECT_EQ(motion_of({Key::kArrowLeft}), (Motion{.right = -1}));
  EXPECT_EQ(motion_of({Key::kArrowRight}), (Motion{.right = 1}));
  EXPECT_EQ(motion_of({Key::kArrowUp}), (Motion{.forward = 1}));
  EXPECT_EQ(motion_of({Key::kArrowDown}), (Motion{.forward = -1}));
  EXPECT_EQ(motion_of({Key::kSemicolon}), (Motion{.up = 1}));
  EXPECT_EQ(motion_of({Key::kPeriod}), (Motion{.up = -1}));
  EXPECT_EQ(motion_of({Key::kPlus}), (Motion{.scale = 1}));
  EXPECT_EQ(motion_of({Key::kMinus}), (Motion{.scale = -1}));
  EXPECT_EQ(motion_of({Key::kW, Key::kD}), (Motion{.right = 1, .forward = 1}));
  EXPECT_EQ(motion_of({Key::kA}), motion_of({Key::kArrowLeft}));
  EXPECT_EQ(motion_of({Key::kS}), motion_of({Key::kArrowDown}));
}

TEST(ReviewKeys, OppositeKeysCancelAndTwoAreNoFaster) {
  EXPECT_EQ(motion_of({Key::kW, Key::kArrowUp}), (Motion{.forward = 1}));
  EXPECT_EQ(motion_of({Key::kW, Key::kS}), Motion());
  EXPECT_EQ(motion_of({Key::kW, Key::kArrowUp, Key::kS}), Motion());
  EXPECT_EQ(motion_of({Key::kPlus, Key::kMinus, Key::kSemicolon}), (Motion{.up = 1}));
}

}  // namespace
}  // namespace scene_analyzer::viewer
