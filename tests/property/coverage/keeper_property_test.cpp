#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/property/coverage/random_task.hpp"
#include "tests/property/coverage/tiny_mission.hpp"

namespace swallowtail::coverage {
namespace {

using testing::IsEmpty;

constexpr double kLong_s = 60'000.0;

/// Metres of the sub-cells' lines, in steps of one, that no position on a line came within 1.2 m of.
double unseen_m(const std::vector<Leg>& planned, const std::vector<Vec3>& covered) {
  double out = 0.0;
  for (const Leg& leg : planned) {
    const double length = (leg.exit_m - leg.entry_m).norm();
    for (double s = 1.0; s < length - 1.0; s += 1.0) {
      const Vec3 p = leg.entry_m + (leg.exit_m - leg.entry_m) * (s / length);
      const bool seen = std::any_of(covered.begin(), covered.end(),
                                    [&](const Vec3& c) { return (c - p).squaredNorm() < 1.2 * 1.2; });
      if (!seen) out += 1.0;
    }
  }
  return out;
}

double planned_m(const std::vector<Leg>& legs) {
  double out = 0.0;
  for (const Leg& leg : legs) out += (leg.exit_m - leg.entry_m).norm();
  return out;
}

class KeeperProperty : public testing::Test {
 protected:
  Result<PlanKeeper> keeper(std::uint64_t seed) {
    Rng rng(seed);
    return PlanKeeper::make(test::random_task(rng), planner::Terrain::flat(0.0), {});
  }
};

TEST_F(KeeperProperty, InOrdinaryNoiseEverythingIsFlownOnceAboveTheReserve) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto made = keeper(seed);
    ASSERT_TRUE(made.ok()) << made.error().message;
    const std::vector<Leg> planned = made->plan().legs;
    const auto log = test::fly(*made, {.bias = 1.0, .noise = 0.05}, seed, kLong_s);
    EXPECT_TRUE(log.completed) << "at " << log.time_s << " s, " << made->plan().legs_done << " of "
                               << made->plan().legs.size() << " legs";
    EXPECT_GE(log.energy_min, made->task().battery.reserve - 1e-6);
    EXPECT_THAT(log.faults, IsEmpty());
    EXPECT_EQ(unseen_m(planned, log.covered), 0.0);
    EXPECT_LT(log.cover_flight_m, 1.05 * planned_m(planned) + 5.0);
    for (const auto& reason : log.reasons)
      EXPECT_THAT(reason, testing::HasSubstr("times")) << "needless revision";
  }
}

TEST_F(KeeperProperty, WhenItConsumesMoreThanPredictedTheReserveStillHolds) {
  int solved = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto made = keeper(seed);
    ASSERT_TRUE(made.ok());
    const std::vector<Leg> planned = made->plan().legs;
    const auto log = test::fly(*made, {.bias = 1.15, .noise = 0.03}, seed, kLong_s);
    EXPECT_TRUE(log.completed);
    EXPECT_GE(log.energy_min, made->task().battery.reserve - 0.02 * made->task().battery.capacity);
    EXPECT_THAT(log.faults, IsEmpty());
    EXPECT_EQ(unseen_m(planned, log.covered), 0.0);
    solved += log.revisions;
  }
  EXPECT_GT(solved, 0);
}

TEST_F(KeeperProperty, ALossOfEnergyEndsInALandingNotInAFall) {
  int solved = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto made = keeper(seed);
    ASSERT_TRUE(made.ok());
    const std::vector<Leg> planned = made->plan().legs;
    Rng rng(seed);
    const double loss = 0.3 * made->task().battery.capacity;
    const auto log = test::fly(*made, {.loss_at_s = rng.uniform(20.0, 60.0), .loss = loss}, seed, kLong_s);
    EXPECT_TRUE(log.completed);
    EXPECT_GT(log.energy_min, made->task().battery.reserve - loss);
    EXPECT_THAT(log.faults, IsEmpty());
    EXPECT_EQ(unseen_m(planned, log.covered), 0.0);
    solved += log.revisions;
  }
  EXPECT_GT(solved, 5);
}

TEST_F(KeeperProperty, AStretchLeftOutIsFlownLater) {
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto made = keeper(seed);
    ASSERT_TRUE(made.ok());
    const std::vector<Leg> planned = made->plan().legs;
    const auto log = test::fly(*made, {.skip_from_s = 25.0}, seed, kLong_s);
    EXPECT_TRUE(log.completed);
    EXPECT_THAT(log.faults, IsEmpty());
    EXPECT_EQ(unseen_m(planned, log.covered), 0.0);
    EXPECT_GE(log.revisions, 1);
  }
}

TEST_F(KeeperProperty, AfterALandingElsewhereTheRobotComesAndTheRestIsFlown) {
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto made = keeper(seed);
    ASSERT_TRUE(made.ok());
    const std::vector<Leg> planned = made->plan().legs;
    const auto log = test::fly(*made, {.force_landing_s = 40.0}, seed, kLong_s);
    EXPECT_TRUE(log.completed);
    EXPECT_GE(log.energy_min, made->task().battery.reserve - 1e-6);
    EXPECT_THAT(log.faults, IsEmpty());
    EXPECT_EQ(unseen_m(planned, log.covered), 0.0);
  }
}

}  // namespace
}  // namespace swallowtail::coverage
