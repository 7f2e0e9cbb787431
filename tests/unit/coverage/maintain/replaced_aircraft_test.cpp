#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "coverage/maintain/plan_keeper.hpp"
#include "tests/unit/coverage/maintain/on_leg.hpp"

/// Another aircraft in the middle of a mission, and another keeper.
namespace swallowtail::coverage {
namespace {

const Vec3 kStart_m(0.0, -5.0, 0.0);

Task square_task() {
  Task task;
  task.fields.push_back({1, "square", {{{0, 0}, {160, 0}, {160, 80}, {0, 80}}, {}}, 20.0});
  task.sweep_rad = 0.0;
  task.battery.capacity = 120.0;
  task.battery.reserve = 10.0;
  task.start_m = kStart_m;
  task.charger.start_m = kStart_m;
  return task;
}

class Replaced : public testing::Test {
 protected:
  void SetUp() override {
    auto made = PlanKeeper::make(square_task(), planner::Terrain::flat(0.0), {});
    ASSERT_TRUE(made.ok()) << made.error().message;
    keeper_.emplace(std::move(*made));
    before_ = keeper_->plan();
    AircraftView start;
    start.position_m = kStart_m;
    keeper_->on_vehicle(start);
    for (std::size_t leg = 0; leg < 2; ++leg) fly(leg, 1.0);
    fly(2, 0.5);
    now_s_ = on_leg(before_, 2, 0.5).time_s;
  }

  void fly(std::size_t leg, double share) {
    for (int step = 0; step <= 100; ++step) keeper_->on_vehicle(on_leg(before_, leg, 0.01 * step * share));
  }

  AircraftView landed(const Vec3& at_m, double after_s) const {
    AircraftView view;
    view.time_s = now_s_ + after_s;
    view.position_m = at_m;
    return view;
  }

  std::optional<PlanKeeper> keeper_;
  LivePlan before_;
  double now_s_ = 0.0;
};

TEST_F(Replaced, AnotherAircraftAtTheStartFliesWhatIsLeft) {
  const double left_m = cover_m(before_, 2) - 0.5 * (before_.legs[2].exit_m - before_.legs[2].entry_m).norm();
  ASSERT_TRUE(keeper_->on_vehicle(landed(kStart_m, 30.0)));
  const LivePlan& after = keeper_->plan();
  EXPECT_GT(after.revision, before_.revision);
  EXPECT_NE(after.reason.find("another aircraft"), std::string::npos) << after.reason;
  EXPECT_EQ(after.legs_done, 0U);
  EXPECT_TRUE(keeper_->complete());
  EXPECT_NEAR(cover_m(after, 0), left_m, 3.0) << "what is flown is not flown again, all else is";
  EXPECT_GE(after.legs.front().start_s, now_s_ + 30.0);
  // Its battery is its own.
  ASSERT_TRUE(keeper_->on_battery({now_s_ + 31.0, 70.0, 120.0}));
  EXPECT_NE(keeper_->plan().reason.find("not full"), std::string::npos) << keeper_->plan().reason;
  EXPECT_LE(keeper_->plan().legs.front().energy_before, 70.0);
}

TEST_F(Replaced, AnotherAircraftElsewhereWaitsForTheRobotFirst) {
  const Vec3 away(60.0, -40.0, 0.0);
  ASSERT_TRUE(keeper_->on_vehicle(landed(away, 30.0)));
  const LivePlan& after = keeper_->plan();
  ASSERT_FALSE(after.rendezvous.empty()) << after.reason;
  EXPECT_LT((after.rendezvous.front().site_m - away).norm(), 0.1);
  EXPECT_GT(after.rendezvous.front().robot_arrives_s, now_s_ + 30.0);
}

TEST_F(Replaced, AnotherAircraftInANoFlyAreaIsCarriedOutOfIt) {
  Task task = square_task();
  task.no_fly.push_back({{{50, -50}, {70, -50}, {70, -30}, {50, -30}}, {}});
  auto made = PlanKeeper::make(task, planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(made.ok()) << made.error().message;
  keeper_.emplace(std::move(*made));
  const Vec3 away(60.0, -40.0, 0.0);
  fly(0, 1.0);
  fly(1, 0.5);
  ASSERT_TRUE(keeper_->on_vehicle(landed(away, 30.0)));
  const LivePlan& after = keeper_->plan();
  ASSERT_FALSE(after.rendezvous.empty()) << after.reason;
  const Rendezvous& out = after.rendezvous.front();
  EXPECT_LT((out.site_m - away).norm(), 0.1);
  ASSERT_TRUE(out.carry);
  EXPECT_LT((out.carry_to_m - after.legs.front().entry_m).head<2>().norm(), 0.1);
  EXPECT_EQ(after.legs.front().kind, LegKind::kCover);
  const double carried_s = (out.carry_to_m - out.site_m).norm() / task.charger.speed_mps;
  EXPECT_GE(out.depart_s, out.robot_arrives_s + carried_s);
}

TEST_F(Replaced, AnotherAircraftFarAwayIsCarriedToTheNextLegAtOnce) {
  Task weak = square_task();
  weak.battery.capacity = 66.0;
  weak.charger.speed_mps = 4.0;
  auto made = PlanKeeper::make(weak, planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(made.ok()) << made.error().message;
  keeper_.emplace(std::move(*made));
  before_ = keeper_->plan();
  fly(0, 1.0);
  fly(1, 0.5);
  now_s_ = before_.legs[1].end_s;
  const Vec3 away(-260.0, -15.0, 0.0);
  ASSERT_TRUE(keeper_->on_vehicle(landed(away, 30.0)));
  const Rendezvous& meeting = keeper_->plan().rendezvous.front();
  EXPECT_LT((meeting.site_m - away).norm(), 0.1);
  EXPECT_TRUE(meeting.carry) << "by air it is out of reach";
  EXPECT_EQ(keeper_->plan().legs.front().kind, LegKind::kCover);
}

/// Beyond a gate at x = 200 m that can be shut.
class Gate : public GroundTravel {
 public:
  double drive_s(const Vec2& from, const Vec2& to) const override {
    const bool through = (from.x() > 200.0) != (to.x() > 200.0);
    return through && is_shut ? std::numeric_limits<double>::infinity() : (to - from).norm() / 2.0;
  }
  std::vector<Vec2> bends(const Vec2&, const Vec2&) const override { return {}; }
  bool is_shut = true;
};

TEST_F(Replaced, WhereTheRobotCannotGetToItStaysUntilItCan) {
  const auto gate = std::make_shared<Gate>();
  Task task = square_task();
  task.charger.travel = gate;
  auto made = PlanKeeper::make(task, planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(made.ok()) << made.error().message;
  keeper_.emplace(std::move(*made));
  fly(0, 1.0);
  fly(1, 0.5);
  const Vec3 beyond(230.0, 0.0, 0.0);
  ASSERT_TRUE(keeper_->on_vehicle(landed(beyond, 30.0)));
  EXPECT_EQ(keeper_->plan().reason, "stays landed: the robot has no way to where the aircraft landed");
  EXPECT_FALSE(keeper_->complete());
  EXPECT_FALSE(keeper_->on_vehicle(landed(beyond, 40.0))) << "said once";
  gate->is_shut = false;
  ASSERT_TRUE(keeper_->on_vehicle(landed(beyond, 50.0)));
  EXPECT_TRUE(keeper_->complete()) << keeper_->plan().reason;
  EXPECT_FALSE(keeper_->plan().rendezvous.empty());
}

/// Docked before leg 0, and a landing at that leg's exit: both are met, each under its own number.
TEST_F(Replaced, AMeetingBeforeTheFirstLegSharesItsNumberWithNoLanding) {
  Task weak = square_task();
  weak.battery.capacity = 66.0;
  auto made = PlanKeeper::make(weak, planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(made.ok()) << made.error().message;
  keeper_.emplace(std::move(*made));
  before_ = keeper_->plan();
  for (std::size_t leg = 0; leg < 2; ++leg) fly(leg, 1.0);
  now_s_ = before_.legs[1].end_s;
  const Vec3 away(20.0, -15.0, 0.0);
  ASSERT_TRUE(keeper_->on_vehicle(landed(away, 30.0)));
  AircraftView docked = landed(away, 60.0);
  docked.mode = AircraftMode::kDocked;
  keeper_->on_vehicle(docked);
  weak.revision = 2;
  const Status changed = keeper_->change_task(weak);
  ASSERT_TRUE(changed.ok()) << changed.error().message;
  const LivePlan& plan = keeper_->plan();
  ASSERT_EQ(plan.legs_done, 0U);
  ASSERT_EQ(plan.legs.front().kind, LegKind::kCover);
  const Transfer transfer = plan.legs.front().transfer;
  ASSERT_TRUE(transfer == Transfer::kFDUF || transfer == Transfer::kFDTU) << "a battery does for one strip";
  ASSERT_GE(plan.rendezvous.size(), 2U);
  EXPECT_LT((plan.rendezvous[0].site_m - away).norm(), 0.1);
  EXPECT_EQ(legs_before(plan.rendezvous[0].id), 0U);
  EXPECT_EQ(plan.rendezvous[1].id, exit_id(0));
  EXPECT_LT((plan.rendezvous[1].site_m - plan.legs[0].exit_m).head<2>().norm(), 0.1);
}

TEST_F(Replaced, AnotherAircraftAloftGoesOnFromWhereItIs) {
  AircraftView aloft = landed({80.0, 40.0, 25.0}, 30.0);
  aloft.mode = AircraftMode::kFlying;
  ASSERT_TRUE(keeper_->on_vehicle(aloft));
  EXPECT_EQ(keeper_->plan().legs_done, 0U);
  EXPECT_TRUE(keeper_->energy_at_next_landing().has_value());
  EXPECT_GT(*keeper_->energy_at_next_landing(), square_task().battery.reserve);
}

TEST_F(Replaced, WhatTheFirstAircraftFlewStaysFlownWhenTheFieldsChange) {
  keeper_->on_vehicle(landed(kStart_m, 30.0));
  const double left_m = cover_m(keeper_->plan(), 0);
  EXPECT_TRUE(keeper_->has_begun());
  Task wider = square_task();
  wider.revision = 2;
  wider.fields[0].polygon.outline = {{0, 0}, {170, 0}, {170, 80}, {0, 80}};
  const Status changed = keeper_->change_task(wider);
  ASSERT_TRUE(changed.ok()) << changed.error().message;
  const double strips = std::ceil(80.0 / square_task().sensor_width_m);
  EXPECT_LT(cover_m(keeper_->plan(), 0), left_m + strips * 10.0 + 20.0);
}

TEST_F(Replaced, ALateStateOfTheFirstAircraftIsNoOtherAircraft) {
  const std::uint32_t revision = keeper_->plan().revision;
  EXPECT_FALSE(keeper_->on_vehicle(on_leg(before_, 1, 0.5)));
  EXPECT_EQ(keeper_->plan().revision, revision);
}

TEST_F(Replaced, AKeeperThatGoesOnWithAPlanKnowsThatItsAircraftIsAnother) {
  LivePlan resumed = keeper_->plan();
  ASSERT_EQ(resumed.legs_done, 2U);
  PlanKeeper other(square_task(), planner::Terrain::flat(0.0), {}, resumed);
  ASSERT_TRUE(other.on_vehicle(landed(kStart_m, 30.0)));
  EXPECT_NE(other.plan().reason.find("another aircraft"), std::string::npos) << other.plan().reason;
  EXPECT_NEAR(cover_m(other.plan(), 0), cover_m(before_, 2), 1.0);
}

TEST_F(Replaced, AKeeperThatGoesOnWithAPlanHelpsAnAircraftThatLandedElsewhere) {
  LivePlan resumed = keeper_->plan();
  PlanKeeper other(square_task(), planner::Terrain::flat(0.0), {}, resumed);
  AircraftView stranded = landed({60.0, -40.0, 0.0}, 30.0);
  stranded.legs_done = 2;
  ASSERT_TRUE(other.on_vehicle(stranded));
  EXPECT_EQ(other.plan().legs_done, 2U);
  EXPECT_EQ(other.plan().legs[1].exit_m, before_.legs[1].exit_m);
  ASSERT_FALSE(other.plan().rendezvous.empty());
  EXPECT_LT((other.plan().rendezvous.front().site_m - stranded.position_m).norm(), 0.1);
  EXPECT_NEAR(cover_m(other.plan(), 2), cover_m(before_, 2), 1.0);
}

}  // namespace
}  // namespace swallowtail::coverage
