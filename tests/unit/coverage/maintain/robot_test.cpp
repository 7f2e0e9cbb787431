#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coverage/maintain/plan_keeper.hpp"

/// A ground robot with a battery of its own, while a plan is flown.
namespace swallowtail::coverage {
namespace {

const Vec3 kDepot_m(0.0, -5.0, 0.0);

Task limited_task() {
  Task task;
  task.fields.push_back({1, "square", {{{0, 0}, {160, 0}, {160, 80}, {0, 80}}, {}}, 20.0});
  task.sweep_rad = 0.0;
  task.battery.capacity = 80.0;
  task.battery.reserve = 10.0;
  task.start_m = kDepot_m;
  task.charger.start_m = kDepot_m;
  task.charger.battery = {
      .capacity = 400.0, .drive_per_s = 0.1, .per_charged = 1.0, .refill_s = 30.0, .reserve = 20.0};
  return task;
}

class LimitedRobot : public testing::Test {
 protected:
  void SetUp() override {
    auto made = PlanKeeper::make(limited_task(), planner::Terrain::flat(0.0), {});
    ASSERT_TRUE(made.ok()) << made.error().message;
    keeper_.emplace(std::move(*made));
    ASSERT_GE(keeper_->plan().rendezvous.size(), 3U);
  }
  static std::ptrdiff_t trips(const LivePlan& plan) {
    return std::ranges::count_if(plan.rendezvous, &Rendezvous::by_depot);
  }
  bool tell(double time_s, const Vec3& at_m, double energy) {
    RobotView robot;
    robot.time_s = time_s;
    robot.position_m = at_m;
    robot.energy = energy;
    return keeper_->on_robot(robot);
  }

  std::optional<PlanKeeper> keeper_;
};

TEST_F(LimitedRobot, WhatIsAsPlannedChangesNothing) {
  EXPECT_FALSE(tell(0.0, kDepot_m, 400.0));
  EXPECT_FALSE(tell(6.0, {8.0, 0.0, 0.0}, 399.4));
  EXPECT_EQ(keeper_->plan().revision, 1U);
}

TEST_F(LimitedRobot, LessEnergyThanPlannedBringsATripAndLaterTimes) {
  tell(0.0, kDepot_m, 400.0);
  const LivePlan before = keeper_->plan();
  ASSERT_EQ(trips(before), 0);
  ASSERT_TRUE(tell(6.0, {8.0, 0.0, 0.0}, 110.0));
  const LivePlan& after = keeper_->plan();
  EXPECT_EQ(after.revision, before.revision + 1);
  EXPECT_NE(after.reason.find("robot's energy 110"), std::string::npos) << after.reason;
  EXPECT_GE(trips(after), 1);
  EXPECT_GE(after.end_s, before.end_s);
  ASSERT_EQ(after.rendezvous.size(), before.rendezvous.size());
  double held = 110.0;
  for (const Rendezvous& meeting : after.rendezvous) {
    if (meeting.by_depot) held = 400.0;
    EXPECT_LE(meeting.robot_energy, held);
    EXPECT_GE(meeting.robot_energy_left, 20.0);
    held = meeting.robot_energy_left;
  }
}

/// However often it is told, it is counted from when the robot was to be there.
TEST_F(LimitedRobot, HowLateItIsAddsUp) {
  AircraftView landed;
  const Rendezvous meeting = keeper_->plan().rendezvous.front();
  keeper_->on_vehicle({.position_m = kDepot_m});
  landed.time_s = meeting.land_s;
  landed.position_m = meeting.site_m;
  landed.legs_done = legs_before(meeting.id);
  keeper_->on_vehicle(landed);
  const double drive_s = (meeting.site_m - kDepot_m).head<2>().norm() / limited_task().charger.speed_mps;
  for (const double stood_s : {20.0, 50.0, 80.0, 110.0})
    ASSERT_TRUE(tell(meeting.land_s + stood_s, kDepot_m, 400.0)) << stood_s;
  const double there_s = std::max(meeting.land_s, meeting.robot_arrives_s);
  const long late_s = std::lround(meeting.land_s + 110.0 + drive_s - there_s);
  EXPECT_EQ(keeper_->plan().reason, "times: the robot is " + std::to_string(late_s) + " s late");
}

TEST_F(LimitedRobot, ARefillEndsTheTrip) {
  tell(0.0, kDepot_m, 400.0);
  ASSERT_TRUE(tell(6.0, {8.0, 0.0, 0.0}, 60.0));
  const std::ptrdiff_t planned = trips(keeper_->plan());
  tell(12.0, kDepot_m, 59.0);
  tell(42.0, kDepot_m, 400.0);
  EXPECT_EQ(trips(keeper_->plan()), planned - 1);
}

TEST_F(LimitedRobot, ThatIsEmptyAwayFromItsDepotIsSaidOnce) {
  tell(0.0, kDepot_m, 400.0);
  ASSERT_TRUE(tell(6.0, {8.0, 0.0, 0.0}, 0.0));
  EXPECT_EQ(keeper_->plan().reason, "the robot's own battery is empty at (8, 0), away from its depot");
  EXPECT_FALSE(tell(100.0, {8.0, 0.0, 0.0}, 0.0));
  EXPECT_FALSE(tell(900.0, {8.0, 0.0, 0.0}, 0.0)) << "that it is late is no news";
}

TEST_F(LimitedRobot, WhatCannotLastIsPlannedAllTheSame) {
  Task weak = limited_task();
  weak.charger.battery.capacity = 60.0;  // less than a charge
  EXPECT_FALSE(PlanKeeper::make(weak, planner::Terrain::flat(0.0), {}).ok());
  PlanKeeper keeper(weak, planner::Terrain::flat(0.0), {}, keeper_->plan());
  RobotView robot;
  robot.position_m = kDepot_m;
  robot.energy = 50.0;
  EXPECT_TRUE(keeper.on_robot(robot));
  EXPECT_EQ(trips(keeper.plan()), static_cast<std::ptrdiff_t>(keeper.plan().rendezvous.size()))
      << "it comes full, and fetches the rest with the aircraft on board";
}

}  // namespace
}  // namespace swallowtail::coverage
