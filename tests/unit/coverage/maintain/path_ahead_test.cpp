#include "coverage/maintain/path_ahead.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coverage/maintain/plan_keeper.hpp"

namespace swallowtail::coverage {
namespace {

using planner::Phase;

/// A strip of 80 m from x = 0 on at 8 m/s, begun at a time; a wait of 20 s in its middle.
PathView strip_with_wait(double begin_s, std::uint32_t leg) {
  PathView out;
  out.lands = true;
  out.waypoints = {{begin_s, {0, 0, 20}, Phase::kTransfer, leg},
                   {begin_s + 5.0, {40, 0, 20}, Phase::kCover, leg},
                   {begin_s + 25.0, {40, 0, 20}, Phase::kTransfer, leg},
                   {begin_s + 30.0, {80, 0, 20}, Phase::kCover, leg},
                   {begin_s + 40.0, {80, 0, 0}, Phase::kLanding, leg}};
  return out;
}

TEST(PathAhead, CostsWhatItWaitsAndOnlyBetweenTheTimesAsked) {
  const planner::Terrain terrain = planner::Terrain::flat(0.0);
  EnergyModel energy;
  energy.hover_per_s = 3.0;
  energy.descent_per_s = 0.5;
  const FlightModel model({}, energy, terrain);
  PathAhead path;
  path.join(strip_with_wait(100.0, 0), 0.0);
  EXPECT_NEAR(path.cost(model, 100.0, 140.0).energy, 5.0 + 60.0 + 5.0 + 5.0, 1e-9);
  EXPECT_NEAR(path.cost(model, 103.0, 106.0).energy, 2.0 + 3.0, 1e-9);
  EXPECT_NEAR(path.cost(model, 100.0, 140.0).length_m, 100.0, 1e-9);
  EXPECT_NEAR(path.cost(model, 100.0, 200.0).energy, 75.0, 1e-9) << "nothing on the ground";
}

TEST(PathAhead, HoversBeyondAnEndInTheAir) {
  const planner::Terrain terrain = planner::Terrain::flat(0.0);
  const FlightModel model({}, {}, terrain);
  PathView view = strip_with_wait(100.0, 0);
  view.waypoints.pop_back();
  view.lands = false;
  PathAhead path;
  path.join(view, 0.0);
  EXPECT_NEAR(path.cost(model, 120.0, 150.0).energy, 30.0, 1e-9);
}

TEST(PathAhead, ANewerOneTakesOverWhereItBegins) {
  PathAhead path;
  path.join(strip_with_wait(100.0, 0), 0.0);
  PathView turns;
  turns.waypoints = {{110.0, {40, 0, 20}, Phase::kTransfer, 0}, {120.0, {40, 80, 20}, Phase::kTransfer, 1}};
  path.join(turns, 101.0);
  EXPECT_EQ(path.position_m(102.5), Vec3(20, 0, 20));
  EXPECT_EQ(path.position_m(107.0), Vec3(40, 0, 20));
  EXPECT_EQ(path.position_m(115.0), Vec3(40, 40, 20));
  EXPECT_FALSE(path.lands());
  EXPECT_EQ(path.end_s(), 120.0);
}

TEST(PathAhead, TellsWhichLegsHaveBegun) {
  PathAhead path;
  PathView view = strip_with_wait(100.0, 3);
  view.waypoints.insert(view.waypoints.begin(), {90.0, {0, -80, 20}, Phase::kTransfer, 3});
  path.join(view, 0.0);
  EXPECT_EQ(path.legs_begun(3, 95.0), 0U) << "on its way to it";
  EXPECT_EQ(path.legs_begun(3, 101.0), 1U);
  EXPECT_EQ(path.legs_begun(2, 95.0), 1U) << "the one before is flown";
  EXPECT_EQ(path.leg_end_s(3), 130.0);
  EXPECT_TRUE(std::isinf(path.leg_end_s(4)));
}

/// One strip of 200 m beside another, and energy for all of it.
class PathOfPlan : public testing::Test {
 protected:
  PathOfPlan() {
    Task task;
    task.fields.push_back({1, "two strips", {{{0, 0}, {200, 0}, {200, 20}, {0, 20}}, {}}, 20.0});
    task.sweep_rad = 0.0;
    task.battery.capacity = 200.0;
    task.start_m = task.charger.start_m = Vec3(0.0, -5.0, 0.0);
    keeper_.emplace(PlanKeeper::make(task, planner::Terrain::flat(0.0), {}).value());
    AircraftView start;
    start.position_m = task.start_m;
    keeper_->on_vehicle(start);
    keeper_->on_battery({0.0, 200.0, 200.0});
  }

  /// The aircraft a share into the first leg, flying.
  AircraftView on_first_leg(double share) const {
    const Leg& leg = keeper_->plan().legs.front();
    AircraftView out;
    out.time_s = leg.start_s + share * (leg.end_s - leg.start_s);
    out.position_m = leg.entry_m + share * (leg.exit_m - leg.entry_m);
    out.velocity_mps = 8.0 * (leg.exit_m - leg.entry_m).normalized();
    out.mode = AircraftMode::kFlying;
    return out;
  }

  /// The path of the plan from there on, with a wait before it goes on.
  PathView path_from(const AircraftView& at, double wait_s) const {
    const LivePlan& plan = keeper_->plan();
    PathView out;
    out.coverage_revision = plan.revision;
    out.lands = true;
    double time_s = at.time_s;
    const auto go = [&](const Vec3& to, Phase phase, std::uint32_t leg) {
      time_s += (to - out.waypoints.back().position_m).norm() / 8.0;
      out.waypoints.push_back({time_s, to, phase, leg});
    };
    out.waypoints.push_back({time_s, at.position_m, Phase::kTransfer, 0});
    go(at.position_m + Vec3(0.1 * at.velocity_mps), Phase::kCover, 0);
    time_s += wait_s;
    go(out.waypoints.back().position_m, Phase::kTransfer, 0);
    for (std::uint32_t i = 0; i < plan.legs.size(); ++i) {
      if (i > 0) go(plan.legs[i].entry_m, Phase::kTransfer, i);
      go(plan.legs[i].exit_m, Phase::kCover, i);
    }
    Vec3 ground = plan.legs.back().exit_m;
    ground.z() = 0.0;
    go(ground, Phase::kLanding, static_cast<std::uint32_t>(plan.legs.size()) - 1);
    return out;
  }

  std::optional<PlanKeeper> keeper_;
};

TEST_F(PathOfPlan, AWaitThatTheEnergyDoesNotDoForLandsTheAircraftBefore) {
  const std::uint32_t revision = keeper_->plan().revision;
  const AircraftView at = on_first_leg(0.5);
  keeper_->on_vehicle(on_first_leg(0.4));
  keeper_->on_vehicle(at);
  EXPECT_FALSE(keeper_->on_battery({at.time_s, 160.0, 200.0})) << keeper_->plan().reason;
  keeper_->on_path(path_from(at, 5.0));
  EXPECT_FALSE(keeper_->on_battery({at.time_s, 160.0, 200.0})) << keeper_->plan().reason;
  keeper_->on_path(path_from(at, 120.0));
  ASSERT_TRUE(keeper_->on_battery({at.time_s, 160.0, 200.0}));
  EXPECT_GT(keeper_->plan().revision, revision);
  EXPECT_NE(keeper_->plan().reason.find("energy 160"), std::string::npos) << keeper_->plan().reason;
  EXPECT_EQ(keeper_->plan().legs.front().transfer, Transfer::kFDUF);
  ASSERT_FALSE(keeper_->plan().rendezvous.empty());
  EXPECT_LT((keeper_->plan().rendezvous.front().site_m - at.position_m).head<2>().norm(), 40.0);
}

TEST_F(PathOfPlan, WhatADetourTookIsKeptAtHandByTheNextFlight) {
  const AircraftView at = on_first_leg(0.5);
  keeper_->on_vehicle(on_first_leg(0.4));
  keeper_->on_vehicle(at);
  keeper_->on_path(path_from(at, 50.0));
  ASSERT_TRUE(keeper_->on_battery({at.time_s, 60.0, 200.0}));
  AircraftView landed = at;
  landed.time_s += 20.0;
  landed.position_m = Vec3(-40.0, -40.0, 0.0);
  landed.velocity_mps = Vec3::Zero();
  landed.mode = AircraftMode::kLanded;
  keeper_->on_vehicle(landed);
  landed.time_s += 5.0;
  ASSERT_TRUE(keeper_->on_vehicle(landed)) << keeper_->plan().reason;
  const LivePlan& plan = keeper_->plan();
  ASSERT_FALSE(plan.rendezvous.empty());
  double least = plan.legs.back().energy_after;
  for (std::size_t i = 1; i < plan.rendezvous.size(); ++i)
    least = std::min(least, plan.rendezvous[i].energy_from);
  EXPECT_GT(least, keeper_->task().battery.reserve + 45.0);
}

TEST_F(PathOfPlan, AWaitElsewhereIsNoneOfItsOwn) {
  const AircraftView at = on_first_leg(0.5);
  keeper_->on_vehicle(on_first_leg(0.4));
  keeper_->on_vehicle(at);
  PathView elsewhere = path_from(at, 120.0);
  for (planner::TimedWaypoint& w : elsewhere.waypoints) w.position_m.y() += 30.0;
  keeper_->on_path(elsewhere);
  EXPECT_FALSE(keeper_->on_battery({at.time_s, 160.0, 200.0})) << "the aircraft does not fly it";
}

TEST_F(PathOfPlan, APathThatIsNoneIsRefused) {
  PathView bad = path_from(on_first_leg(0.5), 1.0);
  bad.waypoints[1].time_s = std::numeric_limits<double>::quiet_NaN();
  keeper_->on_path(bad);
  keeper_->on_path({});
  std::swap(bad.waypoints.front(), bad.waypoints.back());
  keeper_->on_path(bad);
  EXPECT_EQ(keeper_->refused(), 3U);
}

}  // namespace
}  // namespace swallowtail::coverage
