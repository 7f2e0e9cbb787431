#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "charger/charging/charging.hpp"
#include "coverage/maintain/plan_keeper.hpp"
#include "tests/unit/coverage/maintain/on_leg.hpp"

/// Where the aircraft comes down, and whether the robot comes there.
namespace swallowtail::coverage {
namespace {

static_assert(PlanKeeper::kAtSite_m < charger::kDocking_m,
              "what is near enough for the plan is for the robot");

constexpr double kOpenTo_m = 200.0;

/// Straight ways, but none east of 200 m.
class OpenInTheWest : public GroundTravel {
 public:
  double drive_s(const Vec2& from, const Vec2& to) const override {
    if (from.x() > kOpenTo_m || to.x() > kOpenTo_m) return std::numeric_limits<double>::infinity();
    return (to - from).norm() / 2.0;
  }
  std::vector<Vec2> bends(const Vec2&, const Vec2&) const override { return {}; }
};

Task field_task() {
  Task task;
  task.fields.push_back({1, "meadow", {{{0, 0}, {240, 0}, {240, 60}, {0, 60}}, {}}, 20.0});
  task.sweep_rad = 0.0;
  task.battery.capacity = 180.0;
  task.battery.reserve = 20.0;
  task.start_m = task.charger.start_m = Vec3(0.0, -5.0, 0.0);
  return task;
}

PlanKeeper keeper_of(const Task& task) {
  return std::move(PlanKeeper::make(task, planner::Terrain::flat(0.0), {})).value();
}

/// Flown to its first landing; set down so far east of it, a while ago.
AircraftView land_beside_first_meeting(PlanKeeper& keeper, double beside_m) {
  keeper.on_vehicle({.position_m = keeper.task().start_m});
  const Rendezvous meeting = keeper.plan().rendezvous.front();
  const std::size_t legs = legs_before(meeting.id);
  for (std::size_t leg = 0; leg < legs; ++leg) {
    for (int step = 0; step <= 100; ++step) keeper.on_vehicle(on_leg(keeper.plan(), leg, 0.01 * step));
  }
  AircraftView landed;
  landed.time_s = meeting.land_s;
  landed.position_m = meeting.site_m + Vec3(beside_m, 0.0, 0.0);
  landed.legs_done = legs;
  keeper.on_vehicle(landed);
  landed.time_s += 2.0;
  keeper.on_vehicle(landed);
  return landed;
}

TEST(Landing, TheRobotComesToWhoeverLandedFartherOffThanItReaches) {
  for (const double beside_m : {0.5, 0.85, 0.95, 1.2, 1.45, 5.0}) {
    PlanKeeper keeper = keeper_of(field_task());
    ASSERT_FALSE(keeper.plan().rendezvous.empty());
    const AircraftView landed = land_beside_first_meeting(keeper, beside_m);
    const Vec3 site_m = keeper.plan().rendezvous.front().site_m;
    EXPECT_LE((site_m - landed.position_m).norm(), charger::kDocking_m) << beside_m;
  }
}

/// On its way east over ground closed to the robot, with this much energy for everything.
LivePlan run_short_in_the_east(double energy) {
  Task task = field_task();
  task.charger.travel = std::make_shared<OpenInTheWest>();
  PlanKeeper keeper = keeper_of(task);
  keeper.on_vehicle({.position_m = task.start_m});
  keeper.on_battery({0.0, task.battery.capacity});
  std::size_t leg = 0;
  while (keeper.plan().legs[leg].exit_m.x() < kOpenTo_m) ++leg;
  for (std::size_t i = 0; i < leg; ++i) {
    for (int step = 0; step <= 100; ++step) keeper.on_vehicle(on_leg(keeper.plan(), i, 0.01 * step));
  }
  for (double share = 0.0; share <= 0.86; share += 0.01) keeper.on_vehicle(on_leg(keeper.plan(), leg, share));
  keeper.on_battery({on_leg(keeper.plan(), leg, 0.86).time_s, energy});
  return keeper.plan();
}

TEST(Landing, AtOnceIsWhereTheRobotComesIfTheEnergyDoes) {
  const LivePlan plan = run_short_in_the_east(20.0 + 22.0);
  ASSERT_NE(plan.reason.find("lands at once"), std::string::npos) << plan.reason;
  ASSERT_FALSE(plan.rendezvous.empty());
  EXPECT_LE(plan.rendezvous.front().site_m.x(), kOpenTo_m);
  EXPECT_GT(plan.rendezvous.front().site_m.x(), kOpenTo_m - 48.0);
  EXPECT_GE(plan.rendezvous.front().energy_from, 20.0);
}

TEST(Landing, AtOnceIsWhereItIsIfTheEnergyDoesForNothingElse) {
  const LivePlan plan = run_short_in_the_east(20.0 + 12.0);
  ASSERT_NE(plan.reason.find("lands at once"), std::string::npos) << plan.reason;
  EXPECT_GT(plan.legs[plan.legs_done].exit_m.x(), kOpenTo_m);
  EXPECT_EQ(plan.legs[plan.legs_done].transfer, Transfer::kEnd);
}

/// What is said of a robot off all ways known, on its way to the next meeting, has no end.
TEST(Landing, NoTimesAreMovedByARobotWithoutAWay) {
  Task task = field_task();
  task.charger.travel = std::make_shared<OpenInTheWest>();
  PlanKeeper keeper = keeper_of(task);
  keeper.on_vehicle({.position_m = task.start_m});
  const LivePlan before = keeper.plan();
  ASSERT_FALSE(before.rendezvous.empty());
  EXPECT_FALSE(keeper.on_robot({.time_s = 500.0, .position_m = Vec3(kOpenTo_m + 1.0, 0.0, 0.0)}));
  EXPECT_EQ(keeper.plan().end_s, before.end_s);
}

/// A robot that waits at the meeting's place does not see who came down where it was to carry the aircraft.
TEST(Landing, WhereItWouldBeCarriedToIsNoMeeting) {
  Task task = field_task();
  LivePlan plan = keeper_of(task).plan();
  Rendezvous& meeting = plan.rendezvous.front();
  meeting.carry = true;
  meeting.carry_to_m = meeting.site_m + Vec3(15.0, 0.0, 0.0);
  PlanKeeper keeper(task, planner::Terrain::flat(0.0), {}, plan);
  const AircraftView landed = land_beside_first_meeting(keeper, 15.0);
  EXPECT_LE((keeper.plan().rendezvous.front().site_m - landed.position_m).norm(), charger::kDocking_m);
}

/// Wherever it is: a plan without end could not be told to anybody.
TEST(Landing, AtOnceTakesNoEndlessTimeWhereNoWayIsKnown) {
  Task task = field_task();
  task.no_fly.push_back(
      {{{300, 0}, {340, 0}, {340, 40}, {300, 40}}, {{{310, 10}, {310, 30}, {330, 30}, {330, 10}}}});
  PlanKeeper keeper = keeper_of(task);
  keeper.on_vehicle({.position_m = task.start_m});
  keeper.on_battery({0.0, task.battery.capacity});
  AircraftView astray = on_leg(keeper.plan(), 0, 0.0);
  for (int step = 0; step < 20; ++step) {
    astray.time_s += 0.1;
    astray.position_m = Vec3(312.0 + 0.8 * step, 20.0, 20.0);
    astray.velocity_mps = Vec3(8.0, 0.0, 0.0);
    keeper.on_vehicle(astray);
  }
  const Leg first = keeper.plan().legs.front();
  const Vec3 below(first.exit_m.x(), first.exit_m.y(), 0.0);
  using planner::Phase;
  keeper.on_path({.coverage_revision = keeper.plan().revision,
                  .lands = true,
                  .waypoints = {{astray.time_s, astray.position_m, Phase::kTransfer, 0},
                                {astray.time_s + 0.5, first.entry_m, Phase::kTransfer, 0},
                                {astray.time_s + 30.0, first.exit_m, Phase::kCover, 0},
                                {astray.time_s + 40.0, below, Phase::kLanding, 0}}});
  ASSERT_TRUE(keeper.on_battery({astray.time_s, task.battery.reserve + 12.0}));
  EXPECT_NE(keeper.plan().reason.find("lands at once"), std::string::npos) << keeper.plan().reason;
  for (const Leg& leg : keeper.plan().legs) EXPECT_LT(leg.end_s, 1e5);
  for (const Rendezvous& meeting : keeper.plan().rendezvous) EXPECT_LT(meeting.depart_s, 1e5);
  EXPECT_LT(keeper.plan().end_s, 1e5);
}

/// The last word is why it stays, however long the robot waits for it elsewhere.
TEST(Landing, WhereTheRobotHasNoWayToIsSaidForGood) {
  Task task = field_task();
  task.charger.travel = std::make_shared<OpenInTheWest>();
  PlanKeeper keeper = keeper_of(task);
  AircraftView landed = land_beside_first_meeting(keeper, kOpenTo_m + 100.0);
  EXPECT_NE(keeper.plan().reason.find("no way to where"), std::string::npos) << keeper.plan().reason;
  const std::uint32_t revision = keeper.plan().revision;
  for (int step = 0; step < 40; ++step) {
    landed.time_s += 10.0;
    keeper.on_robot({.time_s = landed.time_s, .position_m = task.charger.start_m});
    keeper.on_vehicle(landed);
  }
  EXPECT_EQ(keeper.plan().revision, revision) << keeper.plan().reason;
}

}  // namespace
}  // namespace swallowtail::coverage
