#include "coverage/energy/charging.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swallowtail::coverage {
namespace {

TEST(ChargingCurve, IsLinearUnlessItTapers) {
  const ChargingCurve curve{.s_per_unit = 2.0, .full = 100.0};
  EXPECT_TRUE(curve.is_linear());
  EXPECT_EQ(curve.seconds(20.0, 90.0), 140.0);
  EXPECT_EQ(curve.seconds(90.0, 20.0), 0.0);
  EXPECT_EQ(curve.energy_after(20.0, 100.0), 70.0);
  EXPECT_EQ(curve.energy_after(20.0, 1000.0), 100.0);
  EXPECT_EQ(curve.rate(99.0), 0.5);
}

TEST(ChargingCurve, TheVoltagePartIsAnExponential) {
  const ChargingCurve curve{.s_per_unit = 2.0, .full = 100.0, .taper_from = 0.8, .taper_end_rate = 0.1};
  EXPECT_EQ(curve.seconds(20.0, 80.0), 120.0) << "constant current";
  EXPECT_DOUBLE_EQ(curve.rate(90.0), 0.5 * 0.55);
  // de/dt = rate: the rate falls by 0.9 over 20 units, so t = r · 20/0.9 · ln(1/0.1).
  EXPECT_NEAR(curve.seconds(80.0, 100.0), 2.0 * 20.0 / 0.9 * std::log(10.0), 1e-9);
  EXPECT_NEAR(curve.seconds(20.0, 100.0), curve.seconds(20.0, 85.0) + curve.seconds(85.0, 100.0), 1e-9);
  EXPECT_GT(curve.seconds(80.0, 100.0), 2.5 * curve.seconds(60.0, 80.0) / 2.0);
}

TEST(ChargingCurve, IsTheSumOfItsSmallSteps) {
  const ChargingCurve curve{.s_per_unit = 0.7, .full = 320.0, .taper_from = 0.6, .taper_end_rate = 0.05};
  double sum = 0.0;
  constexpr int kSteps = 200'000;
  for (int i = 0; i < kSteps; ++i) sum += 300.0 / kSteps / curve.rate(20.0 + (i + 0.5) * 300.0 / kSteps);
  EXPECT_NEAR(curve.seconds(20.0, 320.0), sum, 1e-4);
}

TEST(ChargingCurve, TimeAndEnergyAreEachOthersInverse) {
  for (const double from : {0.0, 0.3, 0.79, 0.8, 0.9, 1.0}) {
    for (const double end_rate : {0.01, 0.3, 1.0}) {
      const ChargingCurve curve{1.3, 200.0, from, end_rate};
      for (double a = 0.0; a < 200.0; a += 17.0) {
        for (double b = a; b <= 200.0; b += 13.0)
          EXPECT_NEAR(curve.energy_after(a, curve.seconds(a, b)), b, 1e-8);
        EXPECT_EQ(curve.energy_after(a, 1e6), 200.0);
      }
    }
  }
}

/// What lets schedules put charging off (see StopPlanner).
TEST(ChargingCurve, IsNeverQuickerWithMoreHeld) {
  const ChargingCurve curve{1.0, 100.0, 0.5, 0.02};
  for (double low = 0.0; low < 90.0; low += 3.0) {
    for (double more = 0.0; low + more <= 90.0; more += 3.0)
      EXPECT_LE(curve.seconds(low, low + 10.0), curve.seconds(low + more, low + more + 10.0) + 1e-9);
  }
}

}  // namespace
}  // namespace swallowtail::coverage
