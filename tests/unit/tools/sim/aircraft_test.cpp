#include "tools/sim/aircraft.hpp"

#include <gtest/gtest.h>

#include "path_fixture.hpp"

namespace swallowtail::sim {
namespace {

using data::VehicleMode;

Aircraft at_strip() {
  Aircraft aircraft(1, Vec3(0, 5, 0), planner::Terrain::flat(0.0));
  aircraft.learn_legs(plan_of({strip({0, 5, 20}, {100, 5, 20}), strip({100, 15, 20}, {0, 15, 20})}));
  return aircraft;
}

void fly_until(Aircraft& aircraft, double time_s) {
  while (aircraft.motion().time_s + 0.05 <= time_s + 1e-9) aircraft.advance(aircraft.motion().time_s + 0.05);
}

TEST(Aircraft, StandsWhereItStarts) {
  EXPECT_EQ(at_strip().motion().mode, VehicleMode::kLanded);
  const Aircraft aloft(1, Vec3(0, 0, 30), planner::Terrain::flat(0.0));
  EXPECT_EQ(aloft.motion().mode, VehicleMode::kHolding);
}

TEST(Aircraft, IsExactlyWhereItsPathSays) {
  Aircraft aircraft = at_strip();
  ASSERT_EQ(aircraft.offer(one_strip(1, 2.0)), Offer::kAccepted);
  fly_until(aircraft, 1.0);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kLanded);
  EXPECT_EQ(aircraft.motion().path_revision, 0U);
  fly_until(aircraft, 4.5);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kTakingOff);
  EXPECT_NEAR(aircraft.motion().position_m.z(), 10.0, 1e-9);
  EXPECT_NEAR(aircraft.motion().velocity_mps.z(), 4.0, 1e-9);
  fly_until(aircraft, 12.0);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kCovering);
  EXPECT_LT((aircraft.motion().position_m - Vec3(50, 5, 20)).norm(), 1e-9);
  EXPECT_NEAR(aircraft.motion().yaw_rad, 0.0, 1e-9);
  EXPECT_EQ(aircraft.motion().legs_done, 0U);
  fly_until(aircraft, 18.0);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kLanding);
  EXPECT_EQ(aircraft.motion().legs_done, 1U);
  fly_until(aircraft, 25.0);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kLanded);
  EXPECT_EQ(aircraft.motion().position_m, Vec3(100, 5, 0));
  EXPECT_EQ(aircraft.motion().path_revision, 1U);
  EXPECT_EQ(aircraft.motion().coverage_revision, 1U);
}

TEST(Aircraft, TellsWhatItCoveredToTheWaypoint) {
  Aircraft aircraft = at_strip();
  ASSERT_EQ(aircraft.offer(one_strip(1, 0.01)), Offer::kAccepted);
  double covered_m = 0.0;
  double reach_m = 0.0;
  while (aircraft.motion().time_s < 25.0) {
    aircraft.advance(aircraft.motion().time_s + 0.05);
    for (const Stretch& stretch : aircraft.covered()) {
      EXPECT_NEAR(stretch.from_m.x(), reach_m, 1e-9);
      EXPECT_NEAR(stretch.from_m.z(), 20.0, 1e-9);
      reach_m = stretch.to_m.x();
      covered_m += (stretch.to_m - stretch.from_m).norm();
    }
  }
  EXPECT_NEAR(covered_m, 100.0, 1e-9);
}

TEST(Aircraft, RefusesAPathThatBeginsElsewhere) {
  Aircraft aircraft = at_strip();
  data::PathPlan plan = one_strip(1, 2.0);
  plan.waypoints[0].position.x_m = 0.5;
  EXPECT_EQ(aircraft.offer(plan), Offer::kStaleStart);
  EXPECT_EQ(aircraft.offer(plan), Offer::kKnown) << "republished";
  fly_until(aircraft, 5.0);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kLanded);
}

TEST(Aircraft, RefusesAPathThatIsAlreadyUnderWay) {
  Aircraft aircraft = at_strip();
  fly_until(aircraft, 3.0);
  EXPECT_EQ(aircraft.offer(one_strip(1, 2.8)), Offer::kStaleStart) << "0.8 m up by now";
  EXPECT_EQ(aircraft.offer(one_strip(2, 2.95)), Offer::kAccepted) << "0.2 m up";
}

TEST(Aircraft, SwitchesToANewPathWhereItJoins) {
  Aircraft aircraft = at_strip();
  ASSERT_EQ(aircraft.offer(one_strip(1, 0.0)), Offer::kAccepted);
  fly_until(aircraft, 8.0);
  const data::PathPlan detour = PathBuilder(2, 10.0, {50, 5, 20})
                                    .to({60, 5, 30}, 2.0, PathPhase::kTransfer)
                                    .to({100, 5, 20}, 5.0, PathPhase::kCover)
                                    .to({100, 5, 0}, 5.0, PathPhase::kLanding)
                                    .plan;
  ASSERT_EQ(aircraft.offer(detour), Offer::kAccepted);
  fly_until(aircraft, 9.9);
  EXPECT_EQ(aircraft.motion().path_revision, 1U);
  fly_until(aircraft, 11.0);
  EXPECT_EQ(aircraft.motion().path_revision, 2U);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kTransfer);
  EXPECT_LT((aircraft.motion().position_m - Vec3(55, 5, 25)).norm(), 1e-9);
  fly_until(aircraft, 25.0);
  EXPECT_EQ(aircraft.motion().legs_done, 1U);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kLanded);
}

TEST(Aircraft, ReplacesAPathThatHasNotBegun) {
  Aircraft aircraft = at_strip();
  ASSERT_EQ(aircraft.offer(one_strip(1, 5.0)), Offer::kAccepted);
  ASSERT_EQ(aircraft.offer(one_strip(2, 4.0)), Offer::kAccepted);
  fly_until(aircraft, 4.5);
  EXPECT_EQ(aircraft.motion().path_revision, 2U);
  fly_until(aircraft, 6.0);
  EXPECT_EQ(aircraft.motion().path_revision, 2U);
}

TEST(Aircraft, KeepsItsPathWhenThePlannerHasNone) {
  Aircraft aircraft = at_strip();
  ASSERT_EQ(aircraft.offer(one_strip(1, 0.0)), Offer::kAccepted);
  fly_until(aircraft, 6.0);
  data::PathPlan none;
  none.vehicle_id = 1;
  none.revision = 2;
  none.verdict = data::PathVerdict::kNoSafePath;
  EXPECT_EQ(aircraft.offer(none), Offer::kNoSafePath);
  none.revision = 3;
  none.verdict = data::PathVerdict::kContingency;
  EXPECT_EQ(aircraft.offer(none), Offer::kNoWaypoints);
  fly_until(aircraft, 12.0);
  EXPECT_EQ(aircraft.motion().path_revision, 1U);
}

TEST(Aircraft, HoldsAtTheEndOfAContingencyWithoutEndingTheLeg) {
  Aircraft aircraft = at_strip();
  ASSERT_EQ(aircraft.offer(PathBuilder(1, 0.0, {0, 5, 0})
                               .to({0, 5, 20}, 5.0, PathPhase::kTakeOff)
                               .to({50, 5, 20}, 5.0, PathPhase::kCover)
                               .contingency()
                               .plan),
            Offer::kAccepted);
  fly_until(aircraft, 15.0);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kHolding);
  EXPECT_EQ(aircraft.motion().position_m, Vec3(50, 5, 20));
  EXPECT_EQ(aircraft.motion().legs_done, 0U);
}

TEST(Aircraft, DoesNotEndALegAtAContingencyLandingInItsMiddle) {
  Aircraft aircraft = at_strip();
  ASSERT_EQ(aircraft.offer(PathBuilder(1, 0.0, {0, 5, 0})
                               .to({0, 5, 20}, 5.0, PathPhase::kTakeOff)
                               .to({50, 5, 20}, 5.0, PathPhase::kCover)
                               .to({50, 5, 0}, 5.0, PathPhase::kLanding)
                               .contingency()
                               .plan),
            Offer::kAccepted);
  fly_until(aircraft, 20.0);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kLanded);
  EXPECT_EQ(aircraft.motion().legs_done, 0U);
}

TEST(Aircraft, EndsALegOnceHoweverManyPiecesItHas) {
  Aircraft aircraft = at_strip();
  ASSERT_EQ(aircraft.offer(PathBuilder(1, 0.0, {0, 5, 20})
                               .to({0, 5, 20}, 1.0, PathPhase::kHold)
                               .to({30, 5, 20}, 3.0, PathPhase::kCover)
                               .to({50, 15, 20}, 3.0, PathPhase::kTransfer)
                               .to({70, 5, 20}, 3.0, PathPhase::kCover)
                               .to({98, 5, 20}, 3.0, PathPhase::kCover)
                               .to({100, 15, 20}, 2.0, PathPhase::kTransfer, 1)
                               .to({0, 15, 20}, 10.0, PathPhase::kCover, 1)
                               .plan),
            Offer::kStaleStart);
  Aircraft aloft(1, Vec3(0, 5, 20), planner::Terrain::flat(0.0));
  aloft.learn_legs(plan_of({strip({0, 5, 20}, {100, 5, 20}), strip({100, 15, 20}, {0, 15, 20})}));
  ASSERT_EQ(aloft.offer(PathBuilder(1, 0.0, {0, 5, 20})
                            .to({30, 5, 20}, 3.0, PathPhase::kCover)
                            .to({50, 15, 20}, 3.0, PathPhase::kTransfer)
                            .to({98, 5, 20}, 3.0, PathPhase::kCover)
                            .to({100, 15, 20}, 2.0, PathPhase::kTransfer, 1)
                            .to({0, 15, 20}, 10.0, PathPhase::kCover, 1)
                            .plan),
            Offer::kAccepted);
  fly_until(aloft, 8.9);
  EXPECT_EQ(aloft.motion().legs_done, 0U);
  fly_until(aloft, 9.1);
  EXPECT_EQ(aloft.motion().legs_done, 1U)
      << "the strip's end was cut off by the planner, which flies on to leg 1";
  EXPECT_EQ(aloft.motion().leg_index, 1U);
  fly_until(aloft, 22.0);
  EXPECT_EQ(aloft.motion().legs_done, 2U);
  EXPECT_EQ(aloft.motion().mode, VehicleMode::kHolding);
}

TEST(Aircraft, EndsARepositionLegAtItsPlace) {
  data::Leg reposition = strip({50, 5, 20}, {50, 5, 20});
  reposition.kind = data::LegKind::kReposition;
  Aircraft aircraft(1, Vec3(0, 5, 20), planner::Terrain::flat(0.0));
  aircraft.learn_legs(plan_of({reposition, strip({100, 5, 20}, {100, 90, 20})}));
  ASSERT_EQ(aircraft.offer(PathBuilder(1, 0.0, {0, 5, 20})
                               .to({50, 5, 20}, 5.0, PathPhase::kTransfer)
                               .to({100, 5, 20}, 5.0, PathPhase::kTransfer, 1)
                               .plan),
            Offer::kAccepted);
  fly_until(aircraft, 4.0);
  EXPECT_EQ(aircraft.motion().legs_done, 0U);
  fly_until(aircraft, 6.0);
  EXPECT_EQ(aircraft.motion().legs_done, 1U);
}

TEST(Aircraft, RidesOnItsCharger) {
  Aircraft aircraft = at_strip();
  data::ChargerState charger;
  charger.charger_id = 4;
  charger.position = {0.4, 5, 0};
  charger.docked_vehicle_id = 2;
  aircraft.see_charger(charger);
  fly_until(aircraft, 1.0);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kLanded) << "another vehicle's";
  charger.docked_vehicle_id = 1;
  charger.charge_rate = 0.5;
  charger.time_s = 18.0;
  aircraft.see_charger(charger);
  fly_until(aircraft, 20.0);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kDocked);
  EXPECT_EQ(aircraft.motion().docked_charger_id, 4U);
  EXPECT_EQ(aircraft.charge_rate(), 0.5);
  EXPECT_NEAR(aircraft.motion().position_m.x(), 0.4, 1e-3);
  charger.position = {40, 5, 0};
  charger.speed_mps = 3.0;
  aircraft.see_charger(charger);
  const Vec3 before_m = aircraft.motion().position_m;
  aircraft.advance(aircraft.motion().time_s + 0.05);
  EXPECT_LT((aircraft.motion().position_m - before_m).norm(), 2.5) << "no jump";
  fly_until(aircraft, 40.0);
  EXPECT_NEAR(aircraft.motion().position_m.x(), 40.0, 1e-3);
  ASSERT_EQ(aircraft.offer(PathBuilder(1, 42.0, {40, 5, 0}).to({40, 5, 20}, 5.0, PathPhase::kTakeOff).plan),
            Offer::kAccepted);
  fly_until(aircraft, 43.0);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kTakingOff);
  EXPECT_EQ(aircraft.motion().docked_charger_id, 0U);
  EXPECT_EQ(aircraft.charge_rate(), 0.0);
}

TEST(Aircraft, IsNotChargedByASilentCharger) {
  Aircraft aircraft = at_strip();
  data::ChargerState charger;
  charger.charger_id = 4;
  charger.position = {0.4, 5, 0};
  charger.docked_vehicle_id = 1;
  charger.charge_rate = 0.5;
  charger.time_s = 1.0;
  aircraft.see_charger(charger);
  fly_until(aircraft, 1.0 + Aircraft::kPlugSilence_s - 0.1);
  EXPECT_EQ(aircraft.charge_rate(), 0.5);
  fly_until(aircraft, 1.0 + Aircraft::kPlugSilence_s + 0.1);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kDocked);
  EXPECT_EQ(aircraft.charge_rate(), 0.0);
}

TEST(Aircraft, IsNotTakenOnBoardFromFarAway) {
  Aircraft aircraft = at_strip();
  data::ChargerState charger;
  charger.charger_id = 4;
  charger.position = {5, 5, 0};
  charger.docked_vehicle_id = 1;
  aircraft.see_charger(charger);
  fly_until(aircraft, 1.0);
  EXPECT_EQ(aircraft.motion().mode, VehicleMode::kLanded);
}

TEST(Aircraft, DoesNotGoBackInTime) {
  Aircraft aircraft = at_strip();
  fly_until(aircraft, 2.0);
  aircraft.advance(1.0);
  EXPECT_NEAR(aircraft.motion().time_s, 2.0, 1e-9);
}

}  // namespace
}  // namespace swallowtail::sim
