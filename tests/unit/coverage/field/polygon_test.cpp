#include "coverage/field/polygon.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace swallowtail::coverage {
namespace {

using testing::HasSubstr;

const Ring kSquare = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};

TEST(Polygon, RepeatedCollinearAndClosingVerticesAndSpikesAreLeftOut) {
  const auto cleaned =
      clean({{{0, 0}, {5, 0}, {5, 0}, {10, 0}, {10, 10}, {14, 10}, {10, 10}, {0, 10}, {0, 0}}, {}});
  ASSERT_TRUE(cleaned.ok()) << cleaned.error().message;
  EXPECT_EQ(cleaned->outline.size(), 4U);
  EXPECT_NEAR(area_m2(*cleaned), 100.0, 1e-9);
}

TEST(Polygon, RingsAreTurnedTheirWay) {
  Ring clockwise(kSquare.rbegin(), kSquare.rend());
  const auto cleaned = clean({clockwise, {{{2, 2}, {4, 2}, {4, 4}, {2, 4}}}});
  ASSERT_TRUE(cleaned.ok());
  EXPECT_GT(signed_area_m2(cleaned->outline), 0.0);
  EXPECT_LT(signed_area_m2(cleaned->holes.front()), 0.0);
  EXPECT_NEAR(area_m2(*cleaned), 96.0, 1e-9);
  EXPECT_TRUE(contains(*cleaned, Vec2(1, 1)));
  EXPECT_FALSE(contains(*cleaned, Vec2(3, 3)));
  EXPECT_FALSE(contains(*cleaned, Vec2(11, 3)));
}

TEST(Polygon, WhatIsNoFieldIsRefusedByName) {
  const auto why = [](const Polygon& polygon) {
    return clean(polygon).ok() ? std::string("taken") : clean(polygon).error().message;
  };
  EXPECT_THAT(why({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}, {}}), HasSubstr("Self-intersection"));
  EXPECT_THAT(why({{{0, 0}, {10, 10}, {10, 0}, {0, 12}}, {}}), HasSubstr("Self-intersection"));
  EXPECT_THAT(why({{{0, 0}, {10, 0}}, {}}), HasSubstr("no area"));
  EXPECT_THAT(why({{{0, 0}, {5, 0}, {10, 0}}, {}}), HasSubstr("no area"));
  EXPECT_THAT(why({{}, {}}), HasSubstr("no area"));
  EXPECT_THAT(why({{{0, 0}, {10, 0}, {10, std::numeric_limits<double>::quiet_NaN()}}, {}}),
              HasSubstr("finite"));
  EXPECT_THAT(why({kSquare, {{{20, 20}, {22, 20}, {22, 22}}}}), HasSubstr("outside"));
  EXPECT_THAT(why({kSquare, {{{1, 1}, {9, 1}, {9, 9}, {1, 9}}, {{3, 3}, {5, 3}, {5, 5}}}}),
              HasSubstr("nested"));
}

}  // namespace
}  // namespace swallowtail::coverage
