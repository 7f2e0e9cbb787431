#include "coverage/fleet/encounters.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace swallowtail::coverage {
namespace {

/// A robot that drives at 2 m/s from one place to a rendezvous in another.
Member driver(const Vec3& from_m, const Vec3& to_m, double free_s = 0.0) {
  Member out;
  out.task.charger.start_m = from_m;
  out.task.charger.speed_mps = 2.0;
  if (free_s > 0.0) {
    Rendezvous here;
    here.site_m = from_m;
    here.depart_s = free_s;
    out.plan.rendezvous.push_back(here);
  }
  Rendezvous there;
  there.site_m = to_m;
  there.depart_s = 500.0;
  out.plan.rendezvous.push_back(there);
  return out;
}

TEST(Encounters, CrossingDrivesMeetWhereAndWhenTheyCross) {
  const std::vector<Member> members = {driver({0, 50, 0}, {100, 50, 0}), driver({50, 0, 0}, {50, 100, 0})};
  const std::vector<Encounter> found = encounters_of(members, 3.0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].one, 0U);
  EXPECT_EQ(found[0].other, 1U);
  EXPECT_NEAR(found[0].time_s, 25.0, 1e-9);
  EXPECT_NEAR(found[0].distance_m, 0.0, 1e-9);
  EXPECT_NEAR((found[0].place_m - Vec2(50, 50)).norm(), 0.0, 1e-9);
}

TEST(Encounters, OneThatCrossesLaterMeetsNobody) {
  const std::vector<Member> members = {driver({0, 50, 0}, {100, 50, 0}),
                                       driver({50, 0, 0}, {50, 100, 0}, 40.0)};
  EXPECT_TRUE(encounters_of(members, 3.0).empty());
}

TEST(Encounters, OneThatDrivesPastAStandingOneIsTold) {
  const std::vector<Member> members = {driver({0, 50, 0}, {100, 50, 0}), driver({90, 51, 0}, {90, 51, 0})};
  const std::vector<Encounter> found = encounters_of(members, 3.0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].distance_m, 1.0, 1e-9);
  EXPECT_NEAR(found[0].time_s, 45.0, 1e-9);
}

TEST(Encounters, BendsAreDriven) {
  std::vector<Member> members = {driver({0, 0, 0}, {100, 0, 0}), driver({50, 40, 0}, {50, 40, 0})};
  EXPECT_TRUE(encounters_of(members, 3.0).empty());
  members[0].plan.rendezvous[0].robot_bends_m = {Vec3(50, 41, 0)};
  EXPECT_EQ(encounters_of(members, 3.0).size(), 1U);
}

}  // namespace
}  // namespace swallowtail::coverage
