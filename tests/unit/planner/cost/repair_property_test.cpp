#include "planner/cost/repair.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/base/rng.hpp"

namespace swallowtail::planner {
namespace {

/// The angle between two directions, by the law of cosines; good to about 1e-8.
double angle_between(const Vec3& a, const Vec3& b) {
  return std::acos(std::min(1.0, std::max(-1.0, a.dot(b) / (a.norm() * b.norm()))));
}

/// The limits that a polyline breaks, by another way than the one under test.
std::string broken(const std::vector<Vec3>& path, const KinematicLimits& limits) {
  std::string what;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec3 d = path[i] - path[i - 1];
    if (d.norm() < limits.segment_min_m - 1e-7) what += " segment " + std::to_string(i);
    if (std::abs(d.z()) / d.norm() > std::sin(limits.climb_max_rad) + 1e-7)
      what += " climb " + std::to_string(i);
    if (i + 1 < path.size() && angle_between(d, path[i + 1] - path[i]) > limits.turn_max_rad + 1e-6) {
      what += " turn " + std::to_string(i);
    }
  }
  return what;
}

struct Case {
  std::vector<Vec3> path;
  KinematicLimits limits;
};

Case random_case() {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  Case made;
  made.limits.turn_max_rad = rng.uniform(0.05, 2.0);
  made.limits.climb_max_rad = rng.uniform(0.05, 1.2);
  made.limits.segment_min_m = rng.below(3) == 0 ? 0.0 : rng.uniform(0.0, 20.0);
  const Vec3 start(rng.uniform(-100, 100), rng.uniform(-100, 100), rng.uniform(0, 50));
  const double distance = rng.uniform(21.0, 300.0);
  const double heading = rng.uniform(0.0, 2.0 * std::numbers::pi);
  const double climb = rng.uniform(-0.95, 0.95) * made.limits.climb_max_rad;
  const Vec3 goal = start + distance * Vec3(std::cos(climb) * std::cos(heading),
                                            std::cos(climb) * std::sin(heading), std::sin(climb));
  made.path.push_back(start);
  const std::uint64_t waypoints = rng.below(12);
  for (std::uint64_t i = 0; i < waypoints; ++i) {
    if (rng.below(10) == 0) {
      made.path.push_back(made.path.back());  // twice the same place
    } else {
      made.path.emplace_back(rng.uniform(-200, 200), rng.uniform(-200, 200), rng.uniform(-50, 150));
    }
  }
  made.path.push_back(goal);
  return made;
}

RC_GTEST_PROP(Repair, KeepsEveryLimitOnEverySegment, ()) {
  const Case made = random_case();
  const auto repaired = repair(made.path, made.limits);
  RC_ASSERT(repaired.ok());
  RC_ASSERT(broken(*repaired, made.limits) == "");
  RC_ASSERT(keeps(made.limits, *repaired));
  RC_ASSERT(repaired->front() == made.path.front());
  RC_ASSERT(repaired->back() == made.path.back());
  RC_ASSERT(repaired->size() <= made.path.size());
}

RC_GTEST_PROP(Repair, LeavesAloneWhatKeepsTheLimits, ()) {
  const Case made = random_case();
  const std::vector<Vec3> once = repair(made.path, made.limits).value();
  RC_ASSERT(repair(once, made.limits).value() == once);
}

/// A path that bends a little more than it may is not thrown away: its corners stay off the straight line.
TEST(Repair, MovesACornerNoFartherThanItMust) {
  const std::vector<Vec3> path = {Vec3(0, 0, 0), Vec3(50, 40, 0), Vec3(100, 0, 0)};
  const KinematicLimits limits{std::numbers::pi / 4.0, 1.0, 1.0};
  const std::vector<Vec3> repaired = repair(path, limits).value();
  ASSERT_EQ(repaired.size(), 3u);
  EXPECT_NEAR(repaired[1].x(), 50.0, 1e-9);
  EXPECT_NEAR(repaired[1].y(), 50.0 * std::tan(std::numbers::pi / 8.0), 1e-6);
}

TEST(Repair, SaysWhyItCannot) {
  const KinematicLimits limits{1.0, 0.5, 10.0};
  const auto message = [&](const std::vector<Vec3>& path, const KinematicLimits& of) {
    const auto repaired = repair(path, of);
    return repaired ? std::string() : repaired.error().message;
  };
  EXPECT_NE(message({Vec3(0, 0, 0)}, limits).find("two ends"), std::string::npos);
  EXPECT_NE(message({Vec3(0, 0, 0), Vec3(std::nan(""), 0, 0)}, limits).find("not finite"), std::string::npos);
  EXPECT_NE(message({Vec3(0, 0, 0), Vec3(5, 0, 0)}, limits).find("no repair"), std::string::npos);
  EXPECT_NE(message({Vec3(0, 0, 0), Vec3(0, 0, 50)}, limits).find("no repair"), std::string::npos);
  EXPECT_NE(message({Vec3(0, 0, 0), Vec3(50, 0, 0)}, {0.0, 0.5, 1.0}).find("turn limit"), std::string::npos);
  EXPECT_NE(message({Vec3(0, 0, 0), Vec3(50, 0, 0)}, {1.0, 2.0, 1.0}).find("climb limit"), std::string::npos);
  EXPECT_NE(message({Vec3(0, 0, 0), Vec3(50, 0, 0)}, {1.0, 1.0, -1.0}).find("shortest segment"),
            std::string::npos);
}

}  // namespace
}  // namespace swallowtail::planner
