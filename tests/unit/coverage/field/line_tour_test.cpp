#include "coverage/field/detail/line_tour.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace swallowtail::coverage::detail {
namespace {

const Polygon kSquare{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}, {{{40, 40}, {40, 60}, {60, 60}, {60, 40}}}};
const TurnCost kTurn{8.0, std::numbers::pi / 3.0};

TourLeg flown(const Vec2& from, const Vec2& to) { return leg_of(0, {from, to}); }

TEST(LinkCosts, AskForAStopWhereItTurnsSharply) {
  const LinkCosts costs(kSquare, kTurn);
  const TourLeg first = flown({0, 10}, {50, 10});
  EXPECT_DOUBLE_EQ(costs.link_m(first, flown({60, 10}, {90, 10})), 10.0);  // straight on
  EXPECT_DOUBLE_EQ(costs.link_m(first, flown({50, 20}, {0, 20})), 10.0 + 2.0 * 8.0);
  EXPECT_DOUBLE_EQ(costs.link_m(first, flown({50, 20}, {50, 35})), 10.0 + 8.0);
  EXPECT_DOUBLE_EQ(costs.link_m(first, flown({50, 10}, {50, 30})), 8.0);  // at one place
  EXPECT_DOUBLE_EQ(costs.link_m(first, flown({50, 10}, {80, 40})), 0.0);
}

TEST(LinkCosts, AreTheSameBackwards) {
  const LinkCosts costs(kSquare, kTurn);
  const TourLeg a = flown({10, 10}, {35, 50});
  const TourLeg b = flown({65, 45}, {90, 90});
  EXPECT_DOUBLE_EQ(costs.link_m(a, b), costs.link_m(flown({90, 90}, {65, 45}), flown({35, 50}, {10, 10})));
}

TEST(LinkCosts, CountADetourWhereAHoleIsInTheWay) {
  const LinkCosts costs(kSquare, kTurn);
  const TourLeg before = flown({0, 50}, {39, 50});
  const TourLeg after = flown({61, 50}, {100, 50});
  EXPECT_DOUBLE_EQ(costs.open_m(before, after), 22.0);
  EXPECT_GT(costs.link_m(before, after), 22.0 + 2.0 * 8.0);
}

TEST(LineTour, FliesStripsToAndFro) {
  const LinkCosts costs({{{0, 0}, {100, 0}, {100, 50}, {0, 50}}, {}}, kTurn);
  LineTour tour(costs);
  for (const int strip : {2, 1, 3, 0, 4})
    tour.insert(strip, {{5, 5.0 + 10.0 * strip}, {95, 5.0 + 10.0 * strip}});
  tour.improve();
  EXPECT_NEAR(tour.cost_m(), 5 * 90.0 + 4 * (10.0 + 2.0 * 8.0), 1e-9);
}

TEST(LineTour, FollowsALineThatIsDrawnIn) {
  const LinkCosts costs({{{0, 0}, {100, 0}, {100, 50}, {0, 50}}, {}}, kTurn);
  LineTour tour(costs);
  tour.insert(0, {{5, 5}, {95, 5}});
  tour.insert(1, {{5, 15}, {95, 15}});
  const std::size_t at = tour.legs()[0].line == 1 ? 0 : 1;
  const Vec2 before = tour.legs()[at].along;
  tour.replace(1, {{20, 15}, {95, 15}});
  EXPECT_EQ(tour.legs()[at].line, 1);
  EXPECT_EQ(tour.legs()[at].along, before);
  EXPECT_NEAR((tour.legs()[at].exit_m - tour.legs()[at].entry_m).norm(), 75.0, 1e-9);
  tour.remove(0);
  EXPECT_NEAR(tour.cost_m(), 75.0, 1e-9);
}

}  // namespace
}  // namespace swallowtail::coverage::detail
