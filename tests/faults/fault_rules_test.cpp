#include "faults/fault_rules.h"

#include <gtest/gtest.h>

#include "faults/fault_test.h"

namespace scene_analyzer::faults {
namespace {

TEST(FaultRules, OneCallARangeAndAllFromOneOn) {
  Plan plan(parse_rules("vkA:2=device_lost,vkB:2-3=out_of_date,vkC:2+=false"));
  const auto answers = [&](const char* function) {
    std::string text;
    for (int call = 0; call < 5; ++call) text += plan.next_call(function) ? 'x' : '.';
    return text;
  };
  EXPECT_EQ(answers("vkA"), ".x...");
  EXPECT_EQ(answers("vkB"), ".xx..");
  EXPECT_EQ(answers("vkC"), ".xxxx");
  EXPECT_EQ(answers("vkD"), ".....");
  EXPECT_EQ(plan.counts().at("vkD"), 5U);
}

TEST(FaultRules, WhatIsNoRuleIsRefused) {
  for (const char* text : {"vkA", "vkA:1", "vkA=device_lost", "vkA:0=device_lost", "vkA:x=device_lost",
                           "vkA:1=rain", "vkA:1-=device_lost", "vkA:-2=device_lost"})
    EXPECT_THROW(parse_rules(text), std::invalid_argument) << text;
}

TEST(FaultRules, CallsAreSpreadFromTheFirstToTheLast) {
  using Calls = std::vector<std::uint64_t>;
  EXPECT_EQ(spread_calls(5, 10), (Calls{1, 2, 3, 4, 5}));
  EXPECT_EQ(spread_calls(9, 3), (Calls{1, 5, 9}));
  EXPECT_EQ(spread_calls(9, 1), Calls{1});
  EXPECT_EQ(spread_calls(0, 3), Calls{});
}

}  // namespace
}  // namespace scene_analyzer::faults
