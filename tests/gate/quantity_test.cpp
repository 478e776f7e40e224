#include "gate/quantity.h"

#include <gtest/gtest.h>

#include <set>

namespace scene_analyzer::gate {
namespace {

TEST(Quantity, HasAKeyOfItsOwnThatLeadsBack) {
  std::set<std::string> keys;
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    const auto quantity = static_cast<Quantity>(i);
    EXPECT_EQ(quantity_of(info(quantity).key), quantity);
    EXPECT_EQ(quantity_keys()[i], info(quantity).key);
    keys.insert(quantity_keys()[i]);
    EXPECT_LT(info(quantity).least, info(quantity).greatest) << info(quantity).key;
  }
  EXPECT_EQ(keys.size(), kQuantityCount);
  EXPECT_FALSE(quantity_of("defects."));
}

TEST(Quantity, OfARatingAndOfADefectIsTheOneOfThatName) {
  EXPECT_EQ(quantity_of("fourier_transform"), quantity_of(analysis::Metric::kFourierTransform));
  EXPECT_EQ(rated_metric(Quantity::kFirstRating), analysis::Metric::kPolygonsPerPlanarGroup);
  EXPECT_FALSE(rated_metric(Quantity::kAggregate));
  EXPECT_EQ(quantity_of("defects.far_from_origin"), quantity_of(analysis::Defect::kFarFromOrigin));
  EXPECT_FALSE(counted_defect(Quantity::kDefectTotal));
}

TEST(Quantity, SaysWhatToDoAboutItself) {
  std::set<std::string_view> advice;
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    const auto quantity = static_cast<Quantity>(i);
    EXPECT_FALSE(what_to_do(quantity, Bound::kMost).empty());
    EXPECT_FALSE(what_to_do(quantity, Bound::kLeast).empty());
    advice.insert(what_to_do(quantity, Bound::kMost));
  }
  // The two kinds of rendering times share theirs.
  EXPECT_EQ(advice.size(), kQuantityCount - 1);
  EXPECT_NE(what_to_do(*quantity_of("polygons_per_planar_group"), Bound::kMost).find("merge coplanar"),
            std::string_view::npos);
}

TEST(Quantity, IsWrittenForPeople) {
  EXPECT_EQ(value_text(Quantity::kTriangles, 51200), "51200");
  EXPECT_EQ(value_text(Quantity::kFileBytes, 1023), "1023 bytes");
  EXPECT_EQ(value_text(Quantity::kFileBytes, 5.25 * 1024 * 1024), "5.25 MiB");
  EXPECT_EQ(value_text(Quantity::kAggregate, 0.5), "0.5");
  EXPECT_EQ(value_text(Quantity::kRenderingTime, 1.25), "1.25 ms");
}

}  // namespace
}  // namespace scene_analyzer::gate
