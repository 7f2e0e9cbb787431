#include "planner/participant/sortie.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace swallowtail::planner
