#include "planner/replan/front_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/rng.hpp"
#include "planner/cost/navigation.hpp"

namespace swallowtail::planner {
namespace {

struct Scene {
  std::shared_ptr<const World> world;
  PricedRequest request;
};

/// Hills and four tall cylinders between two opposite corners of 600 × 600 m, flown at 30 to 90 m above
/// ground.
Scene random_scene(std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Mountain> hills;
  for (int i = 0; i < 8; ++i) {
    hills.push_back(
        {rng.uniform(0, 600), rng.uniform(0, 600), rng.uniform(10, 50), std::pow(rng.uniform(40, 90), 2.0)});
  }
  Terrain terrain = mountains_terrain(hills, Vec2(0, 0), Vec2(600, 600), 4.0).value();
  Scene scene;
  PlanRequest& plan = scene.request.plan;
  plan.start_m = Vec3(30, 40, 60 + terrain.height_at(30, 40));
  plan.goal_m = Vec3(560, 550, 55 + terrain.height_at(560, 550));
  plan.params.algorithm = "nmopso";
  plan.params.waypoints = 6;
  plan.limits.turn_max_rad = plan.limits.climb_max_rad = std::numbers::pi / 4.0;
  scene.request.cost.preset = "NMOPSO";
  scene.request.cost.altitude = {30, 90};
  std::vector<Obstacle> towers;
  for (std::uint32_t i = 1; i <= 4; ++i) {
    Obstacle tower;
    tower.id = i;
    tower.shape = Cylinder{rng.uniform(15, 40), 400};
    tower.position_m = Vec3(rng.uniform(120, 450), rng.uniform(120, 450), -10);
    tower.margin_m = 1.0;
    towers.push_back(tower);
  }
  scene.world =
      World::make(std::move(terrain), std::move(towers), {Vec3(0, 0, -10), Vec3(600, 600, 300)}).value();
  return scene;
}

FrontReport planned(const Scene& scene, std::uint64_t evaluations = 2'000) {
  auto report = plan_with_front(scene.world, scene.request, {.max_evaluations = evaluations});
  EXPECT_TRUE(report) << report.error().message;
  return std::move(*report);
}

bool dominates(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  bool better = false;
  for (int k = 0; k < 4; ++k) {
    if (a[k] > b[k]) return false;
    better = better || a[k] < b[k];
  }
  return better;
}

/// Looks at a path every decimetre: whether it comes too near to a tower.
bool meets_a_tower(const Scene& scene, const std::vector<Vec3>& path) {
  const double keep_m = scene.request.plan.limits.clearance_m();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int steps = static_cast<int>((path[i] - path[i - 1]).norm() / 0.1) + 1;
    for (int k = 0; k <= steps; ++k) {
      const Vec3 p = path[i - 1] + (path[i] - path[i - 1]) * k / steps;
      for (const Obstacle& tower : scene.world->obstacles()) {
        const double radius_m = std::get<Cylinder>(tower.shape).radius_m;
        const double clear_m = (p - tower.position_m).head<2>().norm() - radius_m - tower.margin_m;
        if (clear_m < keep_m - 1e-6) return true;
      }
    }
  }
  return false;
}

TEST(FrontPlan, NoMemberDominatesAnotherAndTheCertifierJudgesEach) {
  int fronts = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Scene scene = random_scene(seed);
    const FrontReport report = planned(scene);
    if (!report.front) continue;
    ++fronts;
    const PlannedFront& front = *report.front;
    ASSERT_GE(front.members.size(), 5u) << seed;
    EXPECT_GT(front.hypervolume, 0.3) << seed;
    EXPECT_LT(front.hypervolume, 1.0) << seed;
    const ClearanceQuery query(scene.world);
    for (const FrontMember& a : front.members) {
      for (const FrontMember& b : front.members) EXPECT_FALSE(dominates(a.objectives, b.objectives)) << seed;
      ASSERT_EQ(a.polyline.size(), 8u);
      EXPECT_EQ(a.polyline.front(), scene.request.plan.start_m);
      EXPECT_EQ(a.polyline.back(), scene.request.plan.goal_m);
      double length = 0.0;
      std::vector<RoutePoint> route;
      for (std::size_t i = 1; i < a.polyline.size(); ++i) {
        length += (a.polyline[i] - a.polyline[i - 1]).norm();
        route.push_back({a.polyline[i], Phase::kTransfer, 0, 0.0});
      }
      EXPECT_NEAR(a.objectives[0], 1.0 - (a.polyline.back() - a.polyline.front()).norm() / length, 1e-9);
      const VehicleLimits& limits = scene.request.plan.limits;
      EXPECT_EQ(a.certified,
                certify(time_route(a.polyline.front(), 0.0, route, limits), query, limits).certified);
      EXPECT_FALSE(a.certified && meets_a_tower(scene, a.polyline)) << seed;
    }
  }
  EXPECT_GE(fronts, 4);
}

TEST(FrontPlan, ThePlanIsThePickedMemberOrTheNearestCertifiedOne) {
  int flown = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const FrontReport report = planned(random_scene(seed));
    if (!report.front) continue;
    const PlannedFront& front = *report.front;
    const PlanReport& plan = report.priced.plan;
    ASSERT_TRUE(front.picked);
    Eigen::Vector4d low = front.members.front().objectives;
    Eigen::Vector4d high = low;
    for (const FrontMember& member : front.members) {
      low = low.cwiseMin(member.objectives);
      high = high.cwiseMax(member.objectives);
    }
    const auto distance = [&](std::size_t i) {
      double sum = 0.0;
      for (int k = 0; k < 4; ++k) {
        const double extent = high[k] > low[k] ? high[k] - low[k] : 1.0;
        sum += std::pow((front.members[i].objectives[k] - low[k]) / extent, 2.0);
      }
      return std::sqrt(sum);
    };
    for (std::size_t i = 0; i < front.members.size(); ++i) {
      EXPECT_LE(distance(*front.picked), distance(i) + 1e-12) << seed;
      if (!front.members[i].certified) continue;
      ASSERT_TRUE(front.flown) << seed;
      EXPECT_LE(distance(*front.flown), distance(i) + 1e-12) << seed;
    }
    if (!front.flown) {
      EXPECT_EQ(plan.status, PlanStatus::kNoneFound);
      EXPECT_TRUE(plan.path.empty());
      EXPECT_EQ(report.priced.attempt, front.members[*front.picked].polyline);
      continue;
    }
    ++flown;
    const FrontMember& member = front.members[*front.flown];
    EXPECT_TRUE(member.certified);
    EXPECT_EQ(plan.status, PlanStatus::kCertified) << plan.reason;
    EXPECT_TRUE(plan.certificate.certified);
    EXPECT_EQ(plan.path.front().position_m, member.polyline.front());
    EXPECT_EQ(plan.path.back().position_m, member.polyline.back());
    EXPECT_EQ(plan.cost, member.objectives.sum());
    EXPECT_EQ(report.priced.terms.terms.size(), 4u);
  }
  EXPECT_GE(flown, 4);
}

TEST(FrontPlan, AMemberOutOfBoundsIsNotCertified) {
  int certified = 0;
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scene scene = random_scene(seed);
    const PlanRequest& plan = scene.request.plan;
    const double ceiling_m = std::max(plan.start_m.z(), plan.goal_m.z()) + 3.0;
    const auto towers = scene.world->obstacles();
    scene.world = World::make(scene.world->terrain(), {towers.begin(), towers.end()},
                              {Vec3(0, 0, -10), Vec3(600, 600, ceiling_m)})
                      .value();
    const FrontReport report = planned(scene, 1'000);
    if (!report.front) continue;
    for (const FrontMember& member : report.front->members) {
      bool above = false;
      for (const Vec3& p : member.polyline) above = above || p.z() > ceiling_m;
      EXPECT_FALSE(member.certified && above) << seed;
      ++(member.certified ? certified : refused);
    }
    const std::optional<std::size_t> flown = report.front->flown;
    EXPECT_EQ(flown.has_value(), report.priced.plan.status == PlanStatus::kCertified);
    EXPECT_TRUE(!flown || report.front->members[*flown].certified) << seed;
  }
  EXPECT_GT(certified, 0);
  EXPECT_GT(refused, 0);
}

TEST(FrontPlan, SameSeedSameFront) {
  const Scene scene = random_scene(2);
  const FrontReport a = planned(scene, 1'000);
  const FrontReport b = planned(scene, 1'000);
  ASSERT_TRUE(a.front && b.front);
  ASSERT_EQ(a.front->members.size(), b.front->members.size());
  EXPECT_EQ(a.front->hypervolume, b.front->hypervolume);
  EXPECT_EQ(a.front->picked, b.front->picked);
  for (std::size_t i = 0; i < a.front->members.size(); ++i) {
    EXPECT_EQ(a.front->members[i].objectives, b.front->members[i].objectives);
    EXPECT_EQ(a.front->members[i].polyline, b.front->members[i].polyline);
  }
}

TEST(FrontPlan, AWeightedSumStaysWhereAFrontCannotBe) {
  EXPECT_TRUE(returns_front("nmopso"));
  EXPECT_TRUE(returns_front("nmopso-seed"));
  EXPECT_FALSE(returns_front("boa"));
  EXPECT_FALSE(returns_front("nobody"));
  Scene scene = random_scene(2);
  scene.request.plan.params.algorithm = "boa";
  EXPECT_FALSE(planned(scene).front);
  scene.request.plan.params.algorithm = "nmopso";
  scene.request.cost.preset = "IBABC";
  EXPECT_FALSE(planned(scene).front);
  scene.request.cost.preset = "NMOPSO";
  scene.request.cost.weights = {{"F1", 2.0}};
  EXPECT_FALSE(planned(scene).front);
  scene.request.cost.weights.clear();
  scene.request.plan.start_m.z() += 100.0;
  const FrontReport off_band = planned(scene);
  EXPECT_FALSE(off_band.front);
  EXPECT_NE(off_band.priced.plan.reason.find("There is no front: The start"), std::string::npos)
      << off_band.priced.plan.reason;
}

TEST(FrontPlan, ABlockedStartHasItsStatus) {
  Scene scene = random_scene(2);
  const Obstacle& tower = scene.world->obstacles()[0];
  scene.request.plan.start_m = tower.position_m + Vec3(0, 0, 100);
  const FrontReport report = planned(scene);
  EXPECT_FALSE(report.front);
  EXPECT_EQ(report.priced.plan.status, PlanStatus::kStartBlocked);
}

}  // namespace
}  // namespace swallowtail::planner
