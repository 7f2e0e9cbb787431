#include "coverage/field/polygon.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace swallowtail::coverage {
namespace {

using testing::HasSubstr;

const Ring kSquare = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};

TEST(Polygon, RepeatedCollinearAndClosingVerticesAndSpikesAreLeftOut) {
  const auto cleaned =
      clean({{{0, 0}, {5, 0}, {5, 0}, {10, 0}, {10, 10}, {14, 10}, {10, 10}, {0, 10}, {0, 0}}, {}});
  ASSERT_TRUE(cleaned.ok()) << cleaned.error().message;
  ASSERT_EQ(cleaned->size(), 1U);
  EXPECT_EQ(cleaned->front().outline.size(), 4U);
  EXPECT_NEAR(area_m2(cleaned->front()), 100.0, 1e-9);
}

TEST(Polygon, RingsAreTurnedTheirWay) {
  Ring clockwise(kSquare.rbegin(), kSquare.rend());
  const auto cleaned = clean({clockwise, {{{2, 2}, {4, 2}, {4, 4}, {2, 4}}}});
  ASSERT_TRUE(cleaned.ok());
  const Polygon& polygon = cleaned->front();
  EXPECT_GT(signed_area_m2(polygon.outline), 0.0);
  EXPECT_LT(signed_area_m2(polygon.holes.front()), 0.0);
  EXPECT_NEAR(area_m2(polygon), 96.0, 1e-9);
  EXPECT_TRUE(contains(polygon, Vec2(1, 1)));
  EXPECT_FALSE(contains(polygon, Vec2(3, 3)));
  EXPECT_FALSE(contains(polygon, Vec2(11, 3)));
}

double total_m2(const std::vector<Polygon>& parts) {
  double out = 0.0;
  for (const Polygon& part : parts) out += area_m2(part);
  return out;
}

TEST(Polygon, SmallFaultsAreMended) {
  const auto loop =
      clean({{{0, 0}, {10, 0}, {10, 10}, {5.05, 10}, {4.95, 10.1}, {5.05, 10.1}, {4.95, 10}, {0, 10}}, {}});
  ASSERT_TRUE(loop.ok()) << loop.error().message;
  EXPECT_NEAR(total_m2(*loop), 100.0, 0.1);
  const auto touching =
      clean({kSquare, {{{1, 1}, {4, 1}, {4, 4}, {1, 4}}, {{4, 1}, {7, 1}, {7, 4}, {4, 4}}}});
  ASSERT_TRUE(touching.ok()) << touching.error().message;
  ASSERT_EQ(touching->size(), 1U);
  EXPECT_EQ(touching->front().holes.size(), 1U) << "two holes with a common side are one";
  EXPECT_NEAR(total_m2(*touching), 82.0, 1e-9);
}

TEST(Polygon, AHoleThatCutsThroughMakesTwoParts) {
  const auto cut = clean({kSquare, {{{5, 0}, {7, 5}, {5, 10}, {3, 5}}}});
  ASSERT_TRUE(cut.ok()) << cut.error().message;
  EXPECT_EQ(cut->size(), 2U);
  EXPECT_NEAR(total_m2(*cut), 80.0, 1e-9);
}

TEST(Polygon, WhatIsNoFieldIsRefusedByName) {
  const auto why = [](const Polygon& polygon) {
    return clean(polygon).ok() ? std::string("taken") : clean(polygon).error().message;
  };
  EXPECT_THAT(why({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}, {}}), HasSubstr("Self-intersection"));
  EXPECT_THAT(why({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}, {}}), HasSubstr("(5.00, 5.00) m"));
  EXPECT_THAT(why({{{0, 0}, {10, 10}, {10, 0}, {0, 12}}, {}}), HasSubstr("Self-intersection"));
  EXPECT_THAT(why({{{0, 0}, {10, 0}}, {}}), HasSubstr("no area"));
  EXPECT_THAT(why({{{0, 0}, {5, 0}, {10, 0}}, {}}), HasSubstr("no area"));
  EXPECT_THAT(why({{}, {}}), HasSubstr("empty"));
  EXPECT_THAT(why({{{0, 0}, {10, 0}, {10, std::numeric_limits<double>::quiet_NaN()}}, {}}),
              HasSubstr("finite"));
  EXPECT_THAT(why({kSquare, {{{20, 20}, {22, 20}, {22, 22}}}}), HasSubstr("outside"));
  EXPECT_THAT(why({kSquare, {{{1, 1}, {9, 1}, {9, 9}, {1, 9}}, {{3, 3}, {5, 3}, {5, 5}}}}),
              HasSubstr("nested"));
}

}  // namespace
}  // namespace swallowtail::coverage
