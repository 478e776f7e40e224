#include "gpu/reflection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <random>

#include "gpu/error.h"
#include "parameters.h"
// Generated:
#include "echo_params.spv.h"
#include "gap_in_bindings.spv.h"
#include "write_constants.spv.h"
#include "write_index.spv.h"

namespace scene_analyzer {
namespace {

using gpu::BlockMember;
using gpu::reflect;
using interface::gpu_test::WideParams;
using interface::gpu_test::WriteIndexParams;
using testing::ElementsAre;

testing::Matcher<BlockMember> is_member(const std::string& name, std::size_t offset, std::size_t size) {
  return testing::AllOf(testing::Field(&BlockMember::name, name),
                        testing::Field(&BlockMember::offset_bytes, offset),
                        testing::Field(&BlockMember::size_bytes, size));
}
#define IS_MEMBER(Params, member) is_member(#member, offsetof(Params, member), sizeof(Params::member))

TEST(ReflectionTest, FindsBindingsBlockAndLocalSize) {
  const gpu::Reflection shader = reflect(write_index_spv);
  EXPECT_THAT(shader.local_size, ElementsAre(64, 1, 1));
  ASSERT_EQ(shader.storage_buffers.size(), 2u);
  EXPECT_EQ(shader.storage_buffers[0].name, "Values");
  EXPECT_EQ(shader.storage_buffers[1].name, "Counted");
  EXPECT_EQ(shader.buffer_count, 2u);
  EXPECT_EQ(shader.push_constant_bytes, sizeof(WriteIndexParams));
  EXPECT_THAT(shader.push_constants,
              ElementsAre(IS_MEMBER(WriteIndexParams, count), IS_MEMBER(WriteIndexParams, offset)));
}

TEST(ReflectionTest, OffsetsAndSizeAreThoseOfCpp) {
  const gpu::Reflection shader = reflect(echo_params_spv);
  EXPECT_THAT(shader.push_constants, ElementsAre(IS_MEMBER(WideParams, direction),
                                                 IS_MEMBER(WideParams, count), IS_MEMBER(WideParams, origin),
                                                 IS_MEMBER(WideParams, seed), IS_MEMBER(WideParams, scale)));
  EXPECT_EQ(shader.push_constant_bytes, sizeof(WideParams));  // the padding at the end included
}

TEST(ReflectionTest, LocalSizeFollowsSpecialisation) {
  const std::array<std::uint32_t, 1> constants{96};
  EXPECT_THAT(reflect(write_constants_spv, constants).local_size, ElementsAre(96, 1, 1));
  EXPECT_THAT(reflect(write_constants_spv).local_size, ElementsAre(1, 1, 1));
}

TEST(ReflectionTest, RefusesGapsBetweenBindings) {
  EXPECT_THROW(reflect(gap_in_bindings_spv), gpu::Error);
}

TEST(ReflectionTest, SurvivesTruncatedModules) {
  const std::span<const std::uint32_t> whole(write_index_spv);
  for (std::size_t words = 0; words < whole.size(); ++words) {
    try {
      reflect(
          whole.first(words));  // past the declarations the answer may be right: function bodies are not read
    } catch (const gpu::Error&) {
    }
  }
  EXPECT_THROW(reflect(whole.first(4)), gpu::Error);
  EXPECT_THROW(reflect(whole.first(40)), gpu::Error);
}

TEST(ReflectionTest, SurvivesDamagedModules) {
  std::mt19937 random(1);
  for (int round = 0; round < 20000; ++round) {
    std::vector<std::uint32_t> words(std::begin(echo_params_spv), std::end(echo_params_spv));
    for (int i = 0; i < 3; ++i) words[5 + random() % (words.size() - 5)] = random() % 64;
    try {
      reflect(words);
    } catch (const gpu::Error&) {
    }
  }
}

}  // namespace
}  // namespace scene_analyzer
