// What a task says besides its fields, and where it shows in the plans.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "coverage/participant/coverage_participant.hpp"
#include "coverage/participant/task_of.hpp"
#include "idl/data/validate.hpp"
#include "qos/memory/bus.hpp"

namespace swallowtail::coverage {
namespace {

using Points = std::vector<data::Point2>;

void add_ring(data::CoverageTask& task, data::AreaKind kind, bool is_hole, const Points& points) {
  task.rings.push_back({.area_index = 0,
                        .first_point = static_cast<std::uint32_t>(task.points.size()),
                        .point_count = static_cast<std::uint32_t>(points.size()),
                        .is_hole = is_hole,
                        .kind = kind});
  task.points.insert(task.points.end(), points.begin(), points.end());
}

const Points kBlock{{30, 10}, {70, 10}, {70, 50}, {30, 50}};

/// A field of 100 m × 60 m flown with a sensor of 10 m.
data::CoverageTask field_task() {
  data::CoverageTask task;
  task.fields.push_back({.field_id = 1, .height_m = 20.0});
  add_ring(task, data::AreaKind::kField, false, {{0, 0}, {100, 0}, {100, 60}, {0, 60}});
  task.sensor_width_m = 10.0;
  task.battery.capacity = 150.0;
  task.battery.reserve = 10.0;
  task.start = {-10, -10, 0};
  task.charger.start = {-10, -10, 0};
  return task;
}

/// With a round pond, whose border has a corner between the ends of neighbouring strips.
data::CoverageTask pond_task() {
  data::CoverageTask task = field_task();
  Points pond;
  for (int i = 0; i < 12; ++i)
    pond.push_back({50 + 20 * std::cos(0.5235987755982988 * i), 30 + 20 * std::sin(0.5235987755982988 * i)});
  add_ring(task, data::AreaKind::kField, true, pond);
  return task;
}

struct Answer {
  std::vector<data::CoveragePlan> plans;
  std::vector<data::ChargerPlan> charger;
  std::string message;
};

Answer answer_to(const data::CoverageTask& task) {
  EXPECT_FALSE(data::validate(task)) << *data::validate(task);
  ManualClock wall;
  MemoryNetwork network;
  const auto bus = network.make_bus();
  const auto other = network.make_bus();
  Answer out;
  EXPECT_TRUE(other->subscribe<data::CoveragePlan>(
      {.on_sample = [&](const data::CoveragePlan& p) { out.plans.push_back(p); }}));
  EXPECT_TRUE(other->subscribe<data::ChargerPlan>(
      {.on_sample = [&](const data::ChargerPlan& p) { out.charger.push_back(p); }}));
  EXPECT_TRUE(other->subscribe<data::ParticipantStatus>(
      {.on_sample = [&](const data::ParticipantStatus& s) { out.message = s.message; }}));
  const auto coverage = CoverageParticipant::make(*bus, wall, {}).value();
  EXPECT_TRUE(other->publisher<data::CoverageTask>().value()->publish(task));
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(coverage->step());
    wall.advance(0.02);
  }
  for (const auto& plan : out.plans) EXPECT_FALSE(data::validate(plan)) << *data::validate(plan);
  for (const auto& plan : out.charger) EXPECT_FALSE(data::validate(plan)) << *data::validate(plan);
  return out;
}

/// Every place that the plan's legs and transfers lead through, in order.
std::vector<data::Vec3> flight(const data::CoveragePlan& plan) {
  std::vector<data::Vec3> out;
  for (const data::Leg& leg : plan.legs) {
    for (std::uint32_t i = 0; i < leg.bend_count; ++i) out.push_back(plan.bends.at(leg.first_bend + i));
    out.push_back(leg.entry);
    out.push_back(leg.exit);
  }
  return out;
}

/// How deep the way goes into the box from (30, 10) to (70, 50); negative: how far it keeps away.
double depth_in_block(const std::vector<data::Vec3>& way) {
  double deepest = -1e9;
  for (std::size_t i = 1; i < way.size(); ++i) {
    for (double s = 0.0; s <= 1.0; s += 1e-3) {
      const double x = way[i - 1].x_m + s * (way[i].x_m - way[i - 1].x_m);
      const double y = way[i - 1].y_m + s * (way[i].y_m - way[i - 1].y_m);
      deepest = std::max(deepest, std::min({x - 30, 70 - x, y - 10, 50 - y}));
    }
  }
  return deepest;
}

TEST(TaskOnTheWire, NoTransferCrossesAHole) {
  const Answer answer = answer_to(pond_task());
  ASSERT_EQ(answer.plans.size(), 1U) << answer.message;
  double nearest_m = 1e9;
  const std::vector<data::Vec3> way = flight(answer.plans[0]);
  for (std::size_t i = 1; i < way.size(); ++i) {
    for (double s = 0.0; s <= 1.0; s += 1e-3) {
      nearest_m = std::min(nearest_m, std::hypot(way[i - 1].x_m + s * (way[i].x_m - way[i - 1].x_m) - 50,
                                                 way[i - 1].y_m + s * (way[i].y_m - way[i - 1].y_m) - 30));
    }
  }
  EXPECT_GE(nearest_m, 20.0 * std::cos(0.2617993877991494) - 1e-6) << "of the pond's middle";
}

TEST(TaskOnTheWire, NothingIsFlownInsideANoFlyAreaNorAtItsBorder) {
  data::CoverageTask task = field_task();
  add_ring(task, data::AreaKind::kNoFly, false, kBlock);
  const Answer answer = answer_to(task);
  ASSERT_EQ(answer.plans.size(), 1U) << answer.message;
  EXPECT_LE(depth_in_block(flight(answer.plans[0])), -kOffNoFly_m + 1e-6);
  EXPECT_NEAR(answer.plans[0].field_area_m2, 6000.0 - 40.1 * 40.1, 1e-6);
}

TEST(TaskOnTheWire, TheNoFlyAreaMayReachBeyondTheField) {
  data::CoverageTask task = field_task();
  add_ring(task, data::AreaKind::kNoFly, false, {{60, 20}, {140, 20}, {140, 90}, {60, 90}});
  const Answer answer = answer_to(task);
  ASSERT_EQ(answer.plans.size(), 1U) << answer.message;
  EXPECT_TRUE(answer.plans[0].complete);
}

TEST(TaskOnTheWire, RefusesANoFlyAreaThatIsNoPolygon) {
  data::CoverageTask task = field_task();
  add_ring(task, data::AreaKind::kNoFly, false, {{0, 0}, {40, 0}, {40, 40}, {0, 40}});
  add_ring(task, data::AreaKind::kNoFly, true, {{60, 60}, {90, 60}, {90, 90}});
  const Answer answer = answer_to(task);
  EXPECT_TRUE(answer.plans.empty());
  EXPECT_NE(answer.message.find("No-fly"), std::string::npos) << answer.message;
}

TEST(TaskOnTheWire, SweepAndOverlapAreFollowed) {
  data::CoverageTask task = field_task();
  task.rules.has_sweep = true;
  task.rules.sweep_rad = 1.5707963267948966;
  task.rules.overlap = 0.3;
  const Answer answer = answer_to(task);
  ASSERT_EQ(answer.plans.size(), 1U) << answer.message;
  EXPECT_GE(answer.plans[0].legs.size(), 14U);
  for (const data::Leg& leg : answer.plans[0].legs) EXPECT_NEAR(leg.entry.x_m, leg.exit.x_m, 1e-6);
}

TEST(TaskOnTheWire, SkippedHeadlandIsNotAskedFor) {
  data::CoverageTask task = field_task();
  task.rules.headland = data::HeadlandUse::kSkip;
  task.rules.headland_m = 10.0;
  const Answer answer = answer_to(task);
  ASSERT_EQ(answer.plans.size(), 1U) << answer.message;
  EXPECT_NEAR(answer.plans[0].field_area_m2, 80.0 * 40.0, 1.0);
}

TEST(TaskOnTheWire, RefusesAHeightAboveTheCeiling) {
  data::CoverageTask task = field_task();
  task.rules.has_ceiling = true;
  task.rules.ceiling_m = 15.0;
  const Answer answer = answer_to(task);
  EXPECT_TRUE(answer.plans.empty());
  EXPECT_NE(answer.message.find("ceiling"), std::string::npos) << answer.message;
}

TEST(TaskOnTheWire, EnergyIsThatOfTheModelNamed) {
  const auto used = [](const data::CoverageTask& task) {
    const Answer answer = answer_to(task);
    EXPECT_EQ(answer.plans.size(), 1U) << answer.message;
    const data::Leg& leg = answer.plans.at(0).legs.at(0);
    return (leg.energy_before - leg.energy_after) / (leg.end_s - leg.start_s);
  };
  data::CoverageTask task = field_task();
  const double plain = used(task);
  task.battery.model.altitude_per_m = 0.01;
  EXPECT_NEAR(used(task), 1.2 * plain, 1e-6) << "20 m up";
  task.battery.model.altitude_per_m = 0.0;
  task.battery.model.is_multirotor = true;
  task.battery.model.unit_j = 360.0;
  const double still = used(task);
  EXPECT_GT(std::abs(still - plain), 0.1);
  task.battery.model.wind_east_mps = 8.0;
  EXPECT_GT(std::abs(used(task) - still), 1e-3);
}

TEST(TaskOnTheWire, TheRobotsWaysAndChargingAreInItsPlan) {
  data::CoverageTask task = field_task();
  task.battery.capacity = 100.0;
  task.battery.taper_from = 0.5;
  const Answer straight = answer_to(task);
  ASSERT_EQ(straight.charger.size(), 1U);
  EXPECT_TRUE(straight.charger[0].bends.empty());
  EXPECT_EQ(straight.charger[0].taper_from, 0.5);
  const auto road = [&](const Points& points) {
    task.roads.push_back(
        {static_cast<std::uint32_t>(task.points.size()), static_cast<std::uint32_t>(points.size())});
    task.points.insert(task.points.end(), points.begin(), points.end());
  };
  road({{-10, -10}, {110, -10}, {110, 70}, {-10, 70}});
  task.charger.ground.kind = data::GroundKind::kRoads;
  task.charger.ground.off_road_speed_mps = 0.8;
  task.charger.ground.off_road_max_m = 16.0;
  const Answer answer = answer_to(task);
  ASSERT_EQ(answer.charger.size(), 1U) << answer.message;
  const data::ChargerPlan& plan = answer.charger[0];
  ASSERT_FALSE(plan.rendezvous.empty());
  EXPECT_FALSE(plan.bends.empty());
  const data::Rendezvous& first = plan.rendezvous.front();
  ASSERT_GT(first.bend_count, 0U);
  EXPECT_EQ(plan.bends.at(first.first_bend), (data::Vec3{-10, -10, 0})) << "where it comes from";
  EXPECT_LT(first.speed_mps, task.charger.speed_mps) << "slower off the road";
  EXPECT_GT(first.speed_mps, task.charger.ground.off_road_speed_mps);
}

TEST(TaskOnTheWire, TheRobotsStopsAtItsDepotAndWhatItShouldHoldAreInItsPlan) {
  data::CoverageTask task = field_task();
  task.battery.capacity = 60.0;
  const Answer endless = answer_to(task);
  ASSERT_EQ(endless.charger.size(), 1U) << endless.message;
  EXPECT_FALSE(endless.charger[0].has_battery);
  ASSERT_GE(endless.charger[0].rendezvous.size(), 3U);
  task.charger.has_battery = true;
  task.charger.battery = {.capacity = 110.0, .reserve = 5.0, .drive_per_s = 0.1, .refill_s = 30.0};
  const Answer answer = answer_to(task);
  ASSERT_EQ(answer.charger.size(), 1U) << answer.message;
  const data::ChargerPlan& plan = answer.charger[0];
  EXPECT_EQ(data::validate(plan), data::Refusal{});
  EXPECT_TRUE(plan.has_battery);
  EXPECT_EQ(plan.battery, task.charger.battery);
  int stops = 0;
  double least = 1e9;
  for (std::size_t i = 0; i < plan.rendezvous.size(); ++i) {
    const data::Rendezvous& stop = plan.rendezvous[i];
    EXPECT_GE(stop.robot_energy, i + 1 < plan.rendezvous.size() ? 1e-9 : 0.0);
    if (stop.kind == data::StopKind::kMeeting) {
      least = std::min(least, stop.robot_energy_left);
      EXPECT_LE(stop.robot_energy_left, stop.robot_energy);
      continue;
    }
    ++stops;
    EXPECT_EQ(stop.site, task.charger.start);
    EXPECT_NEAR(stop.depart_s - stop.arrive_by_s, 30.0, 1e-6);
    if (i + 1 < plan.rendezvous.size()) {
      EXPECT_EQ(stop.rendezvous_id, plan.rendezvous[i + 1].rendezvous_id);
    }
  }
  EXPECT_GE(stops, 2) << "on the way, and at the end";
  EXPECT_EQ(plan.rendezvous.back().kind, data::StopKind::kDepot);
  EXPECT_GE(least, 5.0) << "the reserve";
}

TEST(TaskOnTheWire, ClosedGroundIsDrivenRound) {
  data::CoverageTask task = field_task();
  task.battery.capacity = 100.0;
  task.charger.start = task.start = {-20, 30, 0};
  add_ring(task, data::AreaKind::kNoDrive, false, {{-12, -40}, {-4, -40}, {-4, 55}, {-12, 55}});
  task.charger.ground = {.kind = data::GroundKind::kRough,
                         .slope_max_rad = 0.3,
                         .cell_m = 2.0,
                         .area_min = {-60, -60},
                         .area_max = {160, 120}};
  const Answer answer = answer_to(task);
  ASSERT_EQ(answer.charger.size(), 1U) << answer.message;
  ASSERT_FALSE(answer.charger[0].rendezvous.empty());
  double north = -1e9;
  for (const data::Vec3& bend : answer.charger[0].bends) north = std::max(north, bend.y_m);
  EXPECT_GT(north, 55.0);
}

TEST(TaskOnTheWire, APlanTakenUpKeepsItsWays) {
  const Answer answer = answer_to(field_task());
  ASSERT_EQ(answer.plans.size(), 1U) << answer.message;
  data::CoveragePlan plan = answer.plans[0];
  plan.bends = {{-10, -10, 25}, {-5, 70, 25}, {101, 1, 21}, {102, 2, 21}, {103, 3, 21}};
  plan.legs.at(0).bend_count = 2;
  plan.legs.at(2).first_bend = 2;
  plan.legs.at(2).bend_count = 3;
  EXPECT_FALSE(data::validate(plan)) << *data::validate(plan);
  const auto terrain = planner::Terrain::flat(0.0);
  const Task task = task_of(field_task()).value();
  const PlanKeeper keeper(task, terrain, {}, from_wire(plan, task, terrain));
  const data::CoveragePlan again = to_wire(keeper, terrain, task.charger.start_m, 0).coverage;
  EXPECT_EQ(again.bends, plan.bends);
  for (std::size_t i = 0; i < plan.legs.size(); ++i)
    EXPECT_EQ(again.legs.at(i).bend_count, plan.legs[i].bend_count) << "leg " << i;
}

}  // namespace
}  // namespace swallowtail::coverage
