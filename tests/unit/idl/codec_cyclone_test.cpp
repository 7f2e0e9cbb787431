#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

#include "idl/codec/cyclone/mission.hpp"
#include "idl/codec/cyclone/plan.hpp"
#include "idl/codec/cyclone/status.hpp"
#include "idl/codec/cyclone/vehicle.hpp"
#include "idl/codec/cyclone/world.hpp"
#include "tests/unit/idl/samples.hpp"

namespace swallowtail {
namespace {

template <class T>
struct WireOf;
#define WIRE_OF(type)                \
  template <>                        \
  struct WireOf<data::type> {        \
    using Wire = swallowtail_##type; \
  }
WIRE_OF(TerrainTile);
WIRE_OF(Obstacle);
WIRE_OF(VehicleState);
WIRE_OF(BatteryState);
WIRE_OF(CoverageTask);
WIRE_OF(Goal);
WIRE_OF(MissionClock);
WIRE_OF(CoveragePlan);
WIRE_OF(ChargerPlan);
WIRE_OF(PathPlan);
WIRE_OF(ChargerState);
WIRE_OF(ParticipantStatus);

template <class T>
T round_trip(const T& sample) {
  codec::cyclone::Sample<typename WireOf<T>::Wire> wire;
  codec::cyclone::to_wire(sample, *wire);
  T back;
  EXPECT_EQ(codec::cyclone::to_data(*wire, back), data::Refusal{});
  return back;
}

TEST(CycloneCodec, KeepsEveryFieldOfEveryType) {
  testing::for_each_type([](auto type) {
    using T = decltype(type);
    EXPECT_TRUE(rc::check([](std::uint64_t seed) {
      const T sample = testing::make_sample<T>(testing::Extent::kRandom, seed);
      RC_ASSERT(data::validate(sample) == data::Refusal{});
      RC_ASSERT(round_trip(sample) == sample);
    }));
    for (const auto extent : {testing::Extent::kEmpty, testing::Extent::kFull}) {
      const T sample = testing::make_sample<T>(extent, 7);
      ASSERT_EQ(data::validate(sample), data::Refusal{});
      EXPECT_TRUE(round_trip(sample) == sample);
    }
  });
}

TEST(CycloneCodec, ReusesTheWireSampleForShorterAndLongerContent) {
  testing::for_each_type([](auto type) {
    using T = decltype(type);
    codec::cyclone::Sample<typename WireOf<T>::Wire> wire;
    T back;
    for (const auto extent : {testing::Extent::kFull, testing::Extent::kEmpty, testing::Extent::kRandom}) {
      const T sample = testing::make_sample<T>(extent, 11);
      codec::cyclone::to_wire(sample, *wire);
      EXPECT_EQ(codec::cyclone::to_data(*wire, back), data::Refusal{});
      EXPECT_TRUE(back == sample);
    }
  });
}

TEST(CycloneCodec, RefusesEnumeratorsThatDoNotExist) {
  data::Obstacle value;
  codec::cyclone::Sample<swallowtail_Obstacle> wire;
  (*wire).shape = static_cast<swallowtail_ObstacleShape>(5);
  EXPECT_EQ(codec::cyclone::to_data(*wire, value), codec::cyclone::kBadEnumerator);
  data::CoveragePlan plan = testing::make_sample<data::CoveragePlan>(testing::Extent::kFull, 3);
  codec::cyclone::Sample<swallowtail_CoveragePlan> plan_wire;
  codec::cyclone::to_wire(plan, *plan_wire);
  const std::uint32_t number = 0x80000000u;
  std::memcpy(&(*plan_wire).legs._buffer[1].kind, &number, sizeof number);
  EXPECT_EQ(codec::cyclone::to_data(*plan_wire, plan), codec::cyclone::kBadEnumerator);
}

TEST(CycloneCodec, RefusesSequencesAboveTheirBounds) {
  data::PathPlan plan;
  codec::cyclone::Sample<swallowtail_PathPlan> wire;
  (*wire).waypoints._length = data::kMaxWaypoints + 1;
  EXPECT_EQ(codec::cyclone::to_data(*wire, plan), codec::cyclone::kTooLong);
  (*wire).waypoints._length = 0;
}

}  // namespace
}  // namespace swallowtail
