// Which task analyses which assets.
#include "library/shards.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "base/error.h"

namespace scene_analyzer::library {
namespace {

using testing::HasSubstr;
using Variables = std::map<std::string, std::string>;

Shard from(const Variables& variables) {
  return shard_from_environment([&](const char* name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional(found->second);
  });
}

std::string refusal(const Variables& variables) {
  try {
    from(variables);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "none";
}

TEST(Shards, OfSlurmsArrays) {
  EXPECT_EQ(
      from({{"SLURM_ARRAY_TASK_ID", "0"}, {"SLURM_ARRAY_TASK_MIN", "0"}, {"SLURM_ARRAY_TASK_COUNT", "4"}}),
      (Shard{0, 4}));
  EXPECT_EQ(from({{"SLURM_ARRAY_TASK_ID", "19"},
                  {"SLURM_ARRAY_TASK_MIN", "10"},
                  {"SLURM_ARRAY_TASK_MAX", "19"},
                  {"SLURM_ARRAY_TASK_STEP", "3"},
                  {"SLURM_ARRAY_TASK_COUNT", "4"}}),
            (Shard{3, 4}));
}

TEST(Shards, OfKubernetesAndOfTestRunners) {
  EXPECT_EQ(from({{"JOB_COMPLETION_INDEX", "7"}, {"SHARD_COUNT", "8"}}), (Shard{7, 8}));
  EXPECT_EQ(from({{"GTEST_SHARD_INDEX", "1"}, {"GTEST_TOTAL_SHARDS", "2"}}), (Shard{1, 2}));
}

TEST(Shards, VariablesThatMakeNoSenseAreNamed) {
  EXPECT_THAT(refusal({}), HasSubstr("no scheduler's variable is set"));
  EXPECT_THAT(refusal({{"JOB_COMPLETION_INDEX", "1"}}), HasSubstr("SHARD_COUNT is not set"));
  EXPECT_THAT(refusal({{"JOB_COMPLETION_INDEX", "8"}, {"SHARD_COUNT", "8"}}), HasSubstr("SHARD_COUNT says"));
  EXPECT_THAT(refusal({{"JOB_COMPLETION_INDEX", "-1"}, {"SHARD_COUNT", "8"}}), HasSubstr("no whole number"));
  EXPECT_THAT(refusal({{"JOB_COMPLETION_INDEX", ""}, {"SHARD_COUNT", "8"}}), HasSubstr("no whole number"));
  EXPECT_THAT(refusal({{"GTEST_SHARD_INDEX", "0"}, {"GTEST_TOTAL_SHARDS", "0"}}), HasSubstr("from 1 to"));
  for (const char* task : {"1", "2", "6"})
    EXPECT_THAT(refusal({{"SLURM_ARRAY_TASK_ID", task},
                         {"SLURM_ARRAY_TASK_MIN", "1"},
                         {"SLURM_ARRAY_TASK_MAX", "6"},
                         {"SLURM_ARRAY_TASK_STEP", "1"},
                         {"SLURM_ARRAY_TASK_COUNT", "3"}}),
                HasSubstr("has gaps"));
  EXPECT_THAT(refusal({{"SLURM_ARRAY_TASK_ID", "5"},
                       {"SLURM_ARRAY_TASK_MIN", "1"},
                       {"SLURM_ARRAY_TASK_STEP", "3"},
                       {"SLURM_ARRAY_TASK_COUNT", "3"}}),
              HasSubstr("--shard-index"));
  EXPECT_THAT(
      refusal({{"SLURM_ARRAY_TASK_ID", "6"}, {"SLURM_ARRAY_TASK_MIN", "1"}, {"SLURM_ARRAY_TASK_COUNT", "3"}}),
      HasSubstr("SLURM_ARRAY_TASK_COUNT says that there are 3"));
}

std::vector<ListedAsset> random_library(std::size_t count) {
  std::mt19937_64 random(7);
  std::vector<ListedAsset> assets;
  for (std::size_t i = 0; i < count; ++i)
    assets.push_back({"asset " + std::to_string(i), (random() % 64) * (random() % 100'000)});
  return assets;
}

TEST(Shards, EveryAssetIsInOneAndAllHaveAboutTheSame) {
  const auto assets = random_library(5000);
  for (const std::uint32_t count : {1U, 2U, 7U, 64U}) {
    const auto shards = assign_shards(assets, count);
    ASSERT_EQ(shards.size(), assets.size());
    std::vector<double> bytes(count);
    for (std::size_t i = 0; i < shards.size(); ++i) {
      ASSERT_LT(shards[i], count);
      bytes[shards[i]] += static_cast<double>(assets[i].bytes);
    }
    EXPECT_LT(*std::ranges::max_element(bytes), 1.05 * *std::ranges::min_element(bytes)) << count;
  }
}

TEST(Shards, TheOrderOfTheListDoesNotMatter) {
  auto assets = random_library(300);
  const auto expected = assign_shards(assets, 5);
  std::map<std::string, std::uint32_t> shard_of;
  for (std::size_t i = 0; i < assets.size(); ++i) shard_of[assets[i].path] = expected[i];
  std::ranges::shuffle(assets, std::mt19937(3));
  const auto shards = assign_shards(assets, 5);
  for (std::size_t i = 0; i < assets.size(); ++i) EXPECT_EQ(shards[i], shard_of[assets[i].path]);
}

TEST(Shards, MayBeMoreThanAssets) {
  const auto shards = assign_shards(random_library(3), 1000);
  EXPECT_EQ(std::set<std::uint32_t>(shards.begin(), shards.end()).size(), 3U);
  EXPECT_TRUE(assign_shards({}, 4).empty());
}

}  // namespace
}  // namespace scene_analyzer::library
