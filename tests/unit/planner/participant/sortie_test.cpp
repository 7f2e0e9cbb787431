#include "planner/participant/sortie.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace swallowtail::planner {
namespace {

using data::Transfer;

data::CoveragePlan plan_of(const std::vector<Transfer>& transfers) {
  data::CoveragePlan plan;
  for (std::size_t i = 0; i < transfers.size(); ++i) {
    data::Leg leg;
    leg.entry = {10.0 * static_cast<double>(i), 0, 20};
    leg.exit = {10.0 * static_cast<double>(i), 50, 20};
    leg.transfer = transfers[i];
    plan.legs.push_back(leg);
  }
  return plan;
}

std::vector<RoutePoint> route(const data::CoveragePlan& plan, const Sortie& sortie, const RouteStart& start) {
  return sortie_route(plan, sortie, start, Terrain::flat(0.0), VehicleLimits{});
}

TEST(SortieRoute, GoesFromTakeOffToTheFirstLanding) {
  const data::CoveragePlan plan = plan_of({Transfer::kFF, Transfer::kFDTU, Transfer::kEnd});
  const std::vector<RoutePoint> points = route(plan, {0, false}, {Vec3(0, 0, 0), true, 0, false});
  ASSERT_EQ(points.size(), 6u);
  EXPECT_EQ(points.front().phase, Phase::kTakeOff);
  EXPECT_EQ(points[2].phase, Phase::kCover);
  EXPECT_EQ(points[4].leg_index, 1u);
  EXPECT_EQ(points.back().phase, Phase::kLanding);
  EXPECT_EQ(points.back().position_m, Vec3(10, 50, 0));
}

TEST(SortieRoute, ResumesAStripWhereItIs) {
  const data::CoveragePlan plan = plan_of({Transfer::kFF, Transfer::kEnd});
  const std::vector<RoutePoint> on_strip = route(plan, {0, false}, {Vec3(0, 20, 20), false, 0, true});
  EXPECT_EQ(on_strip.front().position_m, Vec3(0, 50, 20));
  EXPECT_EQ(on_strip.front().phase, Phase::kCover);
  const std::vector<RoutePoint> beside = route(plan, {0, false}, {Vec3(6, 20, 25), false, 0, true});
  EXPECT_EQ(beside.front().position_m, Vec3(0, 20, 20));
  EXPECT_EQ(beside.front().phase, Phase::kTransfer);
}

TEST(SortieRoute, LandsFirstIfTheLegBeforeEndsTheSortie) {
  const data::CoveragePlan plan = plan_of({Transfer::kFDUF, Transfer::kEnd});
  const std::vector<RoutePoint> due = route(plan, {0, false}, {Vec3(0, 50, 20), false, 1, false});
  EXPECT_EQ(due.back().position_m, Vec3(0, 50, 0));
  EXPECT_EQ(due.back().phase, Phase::kLanding);
  const std::vector<RoutePoint> after = route(plan, {1, false}, {Vec3(0, 50, 20), false, 1, false});
  EXPECT_EQ(after.back().position_m, Vec3(10, 50, 0)) << "that landing was before this sortie";
}

TEST(SortieRoute, HopsToTheEntryBetweenTwoCharges) {
  const data::CoveragePlan plan = plan_of({Transfer::kFDUFDU, Transfer::kEnd});
  const Sortie hop = sortie_from(plan, 1, Vec3(0, 50, 0));
  EXPECT_TRUE(hop.hops_to_entry);
  const std::vector<RoutePoint> points = route(plan, hop, {Vec3(0, 50, 0), true, 1, false});
  EXPECT_EQ(points.back().position_m, Vec3(10, 0, 0));
  EXPECT_EQ(points.back().phase, Phase::kLanding);
  EXPECT_FALSE(sortie_from(plan, 1, Vec3(10, 0, 0)).hops_to_entry);
}

TEST(SortieRoute, LandsWhenAllLegsAreFlown) {
  const data::CoveragePlan plan = plan_of({Transfer::kFF, Transfer::kEnd});
  const std::vector<RoutePoint> points = route(plan, {0, false}, {Vec3(10, 50, 20), false, 2, false});
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(points.back().phase, Phase::kLanding);
}

TEST(SortieRoute, RepositionLegsAreTransfers) {
  data::CoveragePlan plan = plan_of({Transfer::kEnd});
  plan.legs[0].kind = data::LegKind::kReposition;
  for (const RoutePoint& p : route(plan, {0, false}, {Vec3(0, 0, 0), true, 0, false}))
    EXPECT_NE(p.phase, Phase::kCover);
}

/// A plan of two strips whose transfer goes round something at 30 m.
data::CoveragePlan bent_plan(Transfer transfer) {
  data::CoveragePlan plan = plan_of({transfer, Transfer::kEnd});
  plan.bends = {{0, 80, 30}, {10, 80, 30}};
  plan.legs[1].first_bend = 0;
  plan.legs[1].bend_count = 2;
  return plan;
}

std::vector<Vec3> places(const std::vector<RoutePoint>& points) {
  std::vector<Vec3> out;
  for (const RoutePoint& point : points) out.push_back(point.position_m);
  return out;
}

TEST(SortieRoute, TransfersGoThroughTheBendsOfTheirWay) {
  const data::CoveragePlan plan = bent_plan(Transfer::kFF);
  const std::vector<Vec3> whole = places(route(plan, {0, false}, {Vec3(0, 0, 20), false, 0, true}));
  const std::vector<Vec3> expected{Vec3(0, 50, 20), Vec3(0, 50, 30), Vec3(0, 80, 30),  Vec3(10, 80, 30),
                                   Vec3(10, 0, 30), Vec3(10, 0, 20), Vec3(10, 50, 20), Vec3(10, 50, 0)};
  EXPECT_EQ(whole, expected) << "it climbs first and descends last";
}

TEST(SortieRoute, LeavesOutBendsThatAreBehind) {
  const data::CoveragePlan plan = bent_plan(Transfer::kFF);
  const std::vector<Vec3> second = places(route(plan, {0, false}, {Vec3(5, 80.5, 30), false, 1, false}));
  EXPECT_EQ(second.front(), Vec3(10, 80, 30));
  const std::vector<Vec3> none = places(route(plan, {0, false}, {Vec3(10, 60, 30), false, 1, false}));
  EXPECT_EQ(none.front(), Vec3(10, 0, 20));
  const std::vector<Vec3> both = places(route(plan, {0, false}, {Vec3(0, 60, 25), false, 1, false}));
  EXPECT_EQ(both.front(), Vec3(0, 80, 30));
}

TEST(SortieRoute, LandingsAtAnEntryAndTakeOffsFromAnExitGoRoundToo) {
  const auto passes = [](const std::vector<Vec3>& way) {
    return std::find(way.begin(), way.end(), Vec3(10, 80, 30)) != way.end();
  };
  EXPECT_TRUE(passes(places(route(bent_plan(Transfer::kFFDU), {0, false}, {Vec3(0, 0, 0), true, 0, false}))));
  EXPECT_TRUE(
      passes(places(route(bent_plan(Transfer::kFDUF), {1, false}, {Vec3(0, 50, 0), true, 1, false}))));
  const data::CoveragePlan plan = bent_plan(Transfer::kFDUFDU);
  const std::vector<RoutePoint> hop =
      route(plan, sortie_from(plan, 1, Vec3(0, 50, 0)), {Vec3(0, 50, 0), true, 1, false});
  EXPECT_TRUE(passes(places(hop)));
  EXPECT_EQ(hop.back().phase, Phase::kLanding);
}

TEST(SortieRoute, PlansWithOtherBendsAreOthers) {
  const data::CoveragePlan plan = bent_plan(Transfer::kFF);
  data::CoveragePlan other = plan;
  EXPECT_TRUE(same_ahead(plan, other, 0));
  other.bends[1].x_m += 1.0;
  EXPECT_FALSE(same_ahead(plan, other, 0));
  other = plan;
  other.bends.insert(other.bends.begin(), {7, 7, 7});
  other.legs[1].first_bend = 1;
  EXPECT_TRUE(same_ahead(plan, other, 0)) << "where they stand in the pool does not matter";
}

}  // namespace
}  // namespace swallowtail::planner
