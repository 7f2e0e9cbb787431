#include "coverage/energy/transfer.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swallowtail::coverage {
namespace {

/// Two parallel strips 10 m apart at 30 m; at 3 m/s a climb takes 10 s, and a stop 1 s.
class Transfers : public testing::Test {
 protected:
  const planner::Terrain ground_ = planner::Terrain::flat(0.0);
  const FlightModel model_{planner::VehicleLimits{}, EnergyModel{}, ground_};
  const Charger charger_;
  const FlownLeg first_{{0, 0, 30}, {100, 0, 30}};
  const FlownLeg second_{{100, 10, 30}, {0, 10, 30}};
  const LegLink link_ = link_legs(first_, second_, model_, charger_);
  const TransferTerms terms_{.capacity = 100.0,
                             .reserve = 10.0,
                             .charging = {.s_per_unit = 2.0, .full = 100.0},
                             .take_off_s = 5.0,
                             .landing_s = 5.0};
  const double hop_ = 10.0 / 8.0 + 2.0;
  const double down_ = 11.0;
};

TEST_F(Transfers, FlyingOnNeedsTheHopAndNothingElse) {
  const auto enough = TransferOptions(link_, 50.0, terms_).of(Transfer::kFF, 50.0 - hop_);
  ASSERT_TRUE(enough);
  EXPECT_DOUBLE_EQ(enough->time_s, hop_);
  EXPECT_EQ(enough->charged, 0.0);
  EXPECT_FALSE(TransferOptions(link_, 50.0, terms_).of(Transfer::kFF, 50.0 - hop_ + 0.01));
}

TEST_F(Transfers, LandingAtTheExitChargesForTheTakeOffThere) {
  // Lands with 20 - 11 = 9: below the reserve of 10.
  EXPECT_FALSE(TransferOptions(link_, 20.0, terms_).of(Transfer::kFDUF, 50.0));
  const auto choice = TransferOptions(link_, 30.0, terms_).of(Transfer::kFDUF, 50.0);
  ASSERT_TRUE(choice);
  const double lift = 11.0 + 10.0 / 8.0 + 1.0;
  EXPECT_NEAR(choice->charged, 50.0 + lift - 19.0, 1e-9);
  EXPECT_NEAR(choice->time_s, down_ + 5.0 + 2.0 * choice->charged + 5.0 + lift, 1e-9);
  EXPECT_FALSE(TransferOptions(link_, 30.0, terms_).of(Transfer::kFDUF, 95.0)) << "more than a full battery";
}

TEST_F(Transfers, BeingCarriedTakesTheLongerOfDrivingAndCharging) {
  const auto charging = TransferOptions(link_, 30.0, terms_).of(Transfer::kFDTU, 50.0);
  ASSERT_TRUE(charging);
  EXPECT_NEAR(charging->charged, 61.0 - 19.0, 1e-9);
  EXPECT_NEAR(charging->time_s, down_ + 5.0 + 84.0 + 5.0 + 11.0, 1e-9);
  const auto driving = TransferOptions(link_, 80.0, terms_).of(Transfer::kFDTU, 58.0);
  ASSERT_TRUE(driving);
  EXPECT_NEAR(driving->charged, 0.0, 1e-9);
  EXPECT_NEAR(driving->time_s, down_ + 5.0 + 10.0 / 1.6 + 5.0 + 11.0, 1e-9);
}

TEST_F(Transfers, NobodyIsCarriedNowhere) {
  const LegLink same = link_legs(first_, {{100, 0, 30}, {200, 0, 30}}, model_, charger_);
  EXPECT_TRUE(same.same_site);
  EXPECT_FALSE(TransferOptions(same, 50.0, terms_).of(Transfer::kFDTU, 50.0));
  EXPECT_DOUBLE_EQ(same.hop.time_s, 0.0) << "straight on without a stop";
}

TEST_F(Transfers, TheBestIsTheQuickestThatWorks) {
  EXPECT_EQ(TransferOptions(link_, 60.0, terms_).quickest(40.0)->type, Transfer::kFF);
  const auto charged = TransferOptions(link_, 30.0, terms_).quickest(60.0);
  ASSERT_TRUE(charged);
  EXPECT_NE(charged->type, Transfer::kFF);
  for (const Transfer t : {Transfer::kFFDU, Transfer::kFDUF, Transfer::kFDUFDU, Transfer::kFDTU}) {
    const auto other = TransferOptions(link_, 30.0, terms_).of(t, 60.0);
    EXPECT_TRUE(!other || charged->time_s <= other->time_s + 1e-9) << name_of(t);
  }
  EXPECT_FALSE(TransferOptions(link_, 15.0, terms_).quickest(60.0)) << "no landing keeps the reserve";
}

TEST_F(Transfers, TheLeastTimeIsTheQuickestsWhateverTheChargingCurve) {
  TransferTerms tapered = terms_;
  tapered.charging.taper_from = 0.6;
  for (const TransferTerms& terms : {terms_, tapered}) {
    for (double at_exit = 5.0; at_exit <= 100.0; at_exit += 5.0) {
      const TransferOptions options(link_, at_exit, terms);
      for (double at_entry = 0.0; at_entry <= 105.0; at_entry += 5.0) {
        const auto quickest = options.quickest(at_entry);
        const double least_s = options.least_s(at_entry);
        ASSERT_EQ(std::isfinite(least_s), quickest.has_value()) << at_exit << " to " << at_entry;
        EXPECT_NEAR(quickest ? least_s - quickest->time_s : 0.0, 0.0, 1e-9) << at_exit << " to " << at_entry;
      }
    }
  }
}

TEST_F(Transfers, TheAllowanceMultipliesWhatIsFlown) {
  TransferTerms careful = terms_;
  careful.energy_factor = 2.0;
  EXPECT_FALSE(TransferOptions(link_, 50.0, careful).of(Transfer::kFF, 50.0 - hop_));
  EXPECT_TRUE(TransferOptions(link_, 50.0, careful).of(Transfer::kFF, 50.0 - 2.0 * hop_));
}

}  // namespace
}  // namespace swallowtail::coverage
