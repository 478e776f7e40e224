#include "cli/option_parsing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"

namespace scene_analyzer::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// The message of the UsageError that `call` throws; fails the test when it throws nothing.
template <typename Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

TEST(ParseNumber, TakesWhatUsersWrite) {
  EXPECT_EQ(parse_number("alpha", "0", 0, 180), 0);
  EXPECT_EQ(parse_number("alpha", "180", 0, 180), 180);
  EXPECT_EQ(parse_number("alpha", "2.5", 0, 180), 2.5);
  EXPECT_EQ(parse_number("alpha", "+1e-4", 0, 180), 1e-4);
  EXPECT_EQ(parse_number("x", "-3", -5, 5), -3);
}

TEST(ParseNumber, RefusesNonsenseNamingOptionValueAndRange) {
  for (const char* text :
       {"",         " ",     "abc", "1x",     "1 ",      " 1",   "1,5", "nan", "-nan", "NaN", "inf", "-inf",
        "infinity", "1e999", "-1",  "-0.001", "180.001", "0x10", "++1", "+-1", "--1",  "1e",  "."})
    EXPECT_THAT(
        refusal([&] { parse_number("alpha", text, 0, 180, "degrees"); }),
        AllOf(HasSubstr("--alpha"), HasSubstr("'" + std::string(text) + "'"), HasSubstr("[0, 180] degrees")))
        << text;
  EXPECT_THAT(refusal([] { parse_number("weld-tolerance", "-1", 0, std::numeric_limits<double>::max()); }),
              HasSubstr("a number >= 0"));
}

TEST(ParseInteger, RefusesFractionsSignsAndOverflow) {
  EXPECT_EQ(parse_integer("dim", "2", 2, 100), 2U);
  EXPECT_EQ(parse_integer("dim", "100", 2, 100), 100U);
  for (const char* text : {"", "1", "101", "2.0", "2.5", "-2", "2e1", "18446744073709551616", "0x4", "two"})
    EXPECT_THAT(refusal([&] { parse_integer("dim", text, 2, 100); }),
                AllOf(HasSubstr("--dim"), HasSubstr("[2, 100]")))
        << text;
}

TEST(ParseVector3, NeedsThreeFiniteNumbers) {
  EXPECT_EQ(parse_vector3("eye", "-1,2,3"), (mesh::Vector3{-1, 2, 3}));
  EXPECT_EQ(parse_vector3("eye", "1e3,-.5,+0"), (mesh::Vector3{1000, -0.5, 0}));
  for (const char* text :
       {"", ",", "1,2", "1,2,3,4", "1,2,", ",1,2", "1, 2,3", "1;2;3", "1,nan,3", "1,2,inf"})
    EXPECT_THAT(refusal([&] { parse_vector3("eye", text); }), AllOf(HasSubstr("--eye"), HasSubstr("X,Y,Z")))
        << text;
}

TEST(ParseMetrics, KnowsEveryKey) {
  analysis::MetricSet expected;
  std::string all;
  for (std::size_t i = 0; i < analysis::kMetricCount; ++i) {
    expected.set(i);
    all += (i == 0 ? "" : ",") + std::string(analysis::kMetricKeys[i]);
  }
  EXPECT_EQ(parse_metrics("metrics", all), expected);
  EXPECT_EQ(parse_metrics("metrics", "distance").count(), 1U);
}

TEST(ParseMetrics, UnknownKeysListTheKnownOnes) {
  const std::string message = refusal([] { parse_metrics("metrics", "distanze"); });
  EXPECT_THAT(message,
              AllOf(HasSubstr("--metrics"), HasSubstr("'distanze'"), HasSubstr("did you mean distance?")));
  for (const auto key : analysis::kMetricKeys) EXPECT_THAT(message, HasSubstr(std::string(key)));
  EXPECT_THAT(refusal([] { parse_metrics("metrics", "distance,distance"); }), HasSubstr("twice"));
  EXPECT_THAT(refusal([] { parse_metrics("metrics", ""); }), HasSubstr("''"));
  EXPECT_THAT(refusal([] { parse_metrics("metrics", "distance,"); }), HasSubstr("''"));
  EXPECT_THAT(refusal([] { parse_metrics("metrics", "DISTANCE"); }), HasSubstr("DISTANCE"));
}

TEST(ParseWeights, KeysNotNamedWeighNothing) {
  const auto weights = parse_weights("weights", "distance=0.5,relative_density=2");
  std::array<double, analysis::kMetricCount> expected{};
  expected[index_of(analysis::Metric::kDistance)] = 0.5;
  expected[index_of(analysis::Metric::kRelativeDensity)] = 2;
  EXPECT_EQ(weights, expected);
}

TEST(ParseWeights, RefusesNonsense) {
  const auto message = [](const char* text) { return refusal([&] { parse_weights("weights", text); }); };
  EXPECT_THAT(message(""), HasSubstr("KEY=WEIGHT"));
  EXPECT_THAT(message("distance"), HasSubstr("KEY=WEIGHT"));
  EXPECT_THAT(message("distance="), HasSubstr(">= 0"));
  EXPECT_THAT(message("distance=-1"), HasSubstr(">= 0"));
  EXPECT_THAT(message("distance=nan"), HasSubstr(">= 0"));
  EXPECT_THAT(message("distance=inf"), HasSubstr(">= 0"));
  EXPECT_THAT(message("distance=1=2"), HasSubstr(">= 0"));
  EXPECT_THAT(message("distance=1,distance=2"), HasSubstr("twice"));
  EXPECT_THAT(message("distance=0,relative_density=0"), HasSubstr("above 0"));
  EXPECT_THAT(message("density=1"), HasSubstr("relative_density"));
  EXPECT_THAT(message("distance=1,"), HasSubstr("KEY=WEIGHT"));
}

TEST(ParseSize, UnitsArePowersOf1024) {
  EXPECT_EQ(parse_size("max-size", "0"), 0U);
  EXPECT_EQ(parse_size("max-size", "4096"), 4096U);
  EXPECT_EQ(parse_size("max-size", "1K"), 1024U);
  EXPECT_EQ(parse_size("max-size", "1.5M"), 1536U * 1024);
  EXPECT_EQ(parse_size("max-size", "2G"), std::uint64_t{2} << 30);
  EXPECT_EQ(parse_size("max-size", "1T"), std::uint64_t{1} << 40);
  for (const char* text : {"", "K", "-1", "1P", "1KB", "nan", "1e300", "inf", "9999999999T"})
    EXPECT_THAT(refusal([&] { parse_size("max-size", text); }), HasSubstr("--max-size")) << text;
}

TEST(Nearest, SuggestsOnlyWhatIsNear) {
  const std::vector<std::string> names = {"alpha", "dim", "device", "weld-tolerance"};
  EXPECT_EQ(nearest("alhpa", names), "alpha");
  EXPECT_EQ(nearest("alpa", names), "alpha");
  EXPECT_EQ(nearest("weld-tolerence", names), "weld-tolerance");
  EXPECT_EQ(nearest("devices", names), "device");
  EXPECT_EQ(nearest("dun", names), "");
  EXPECT_EQ(nearest("xyzzy", names), "");
  EXPECT_EQ(nearest("", names), "");
}

}  // namespace
}  // namespace scene_analyzer::cli
