#include <gtest/gtest.h>

#include <limits>

#include "idl/data/validate.hpp"
#include "tests/unit/idl/samples.hpp"

// One number after another of a valid sample is replaced by a hostile one: no crash, and no NaN or infinity
// may pass.
namespace swallowtail {
namespace {

using testing::Extent;

constexpr double kHostile[] = {std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity()};

template <class T, class Refer>
void expect_refused(Refer refer) {
  for (const double value : kHostile) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      T sample = testing::make_sample<T>(Extent::kRandom, seed);
      Rng rng(seed);
      refer(sample, rng) = static_cast<std::remove_reference_t<decltype(refer(sample, rng))>>(value);
      EXPECT_TRUE(data::validate(sample)) << "seed " << seed << ", value " << value;
    }
  }
}

TEST(FuzzValidate, NoNumberOfASequenceMayBeInfiniteOrNan) {
  expect_refused<data::TerrainTile>(
      [](auto& t, Rng& rng) -> float& { return t.elevation_m[rng.below(t.elevation_m.size())]; });
  expect_refused<data::CoverageTask>(
      [](auto& t, Rng& rng) -> double& { return t.points[rng.below(t.points.size())].y_m; });
  expect_refused<data::CoverageTask>(
      [](auto& t, Rng& rng) -> double& { return t.fields[rng.below(t.fields.size())].height_m; });
}

TEST(FuzzValidate, NoDoubleOfAFlatTypeMayBeInfiniteOrNan) {
  const auto spoil_each = [](auto type, auto... members) {
    using T = decltype(type);
    (expect_refused<T>([members](auto& sample, Rng&) -> double& { return sample.*members; }), ...);
  };
  using data::BatteryState;
  using data::ChargerState;
  using data::MissionClock;
  using data::Obstacle;
  using data::ParticipantStatus;
  using data::VehicleState;
  spoil_each(MissionClock{}, &MissionClock::time_s, &MissionClock::rate);
  spoil_each(BatteryState{}, &BatteryState::time_s, &BatteryState::energy, &BatteryState::capacity,
             &BatteryState::power, &BatteryState::health);
  spoil_each(VehicleState{}, &VehicleState::time_s, &VehicleState::roll_rad, &VehicleState::pitch_rad,
             &VehicleState::yaw_rad);
  spoil_each(Obstacle{}, &Obstacle::state_time_s, &Obstacle::valid_until_s, &Obstacle::radius_m,
             &Obstacle::height_m, &Obstacle::yaw_rad, &Obstacle::margin_m);
  spoil_each(ChargerState{}, &ChargerState::time_s, &ChargerState::speed_mps, &ChargerState::charge_rate,
             &ChargerState::energy_delivered);
  spoil_each(ParticipantStatus{}, &ParticipantStatus::latency_p50_ms, &ParticipantStatus::latency_p99_ms,
             &ParticipantStatus::latency_max_ms);
}

TEST(FuzzValidate, RandomNumbersNeverCrash) {
  testing::for_each_type([](auto type) {
    using T = decltype(type);
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      T sample = testing::make_sample<T>(Extent::kRandom, seed);
      Rng rng(seed);
      if constexpr (requires { sample.rings; }) {
        for (auto& ring : sample.rings) {
          ring = {static_cast<std::uint32_t>(rng() >> rng.below(64)),
                  static_cast<std::uint32_t>(rng() >> rng.below(64)),
                  static_cast<std::uint32_t>(rng() >> rng.below(64)), rng.below(2) == 0,
                  static_cast<data::AreaKind>(rng.below(4))};
        }
        EXPECT_TRUE(data::validate(sample)) << "seed " << seed;
      } else if constexpr (requires { sample.tile_rows; }) {
        sample.tile_rows = static_cast<std::uint32_t>(rng());
        sample.tile_cols = static_cast<std::uint32_t>(rng());
        EXPECT_TRUE(data::validate(sample)) << "seed " << seed;
      } else {
        (void)data::validate(sample);
      }
    }
  });
}

}  // namespace
}  // namespace swallowtail
