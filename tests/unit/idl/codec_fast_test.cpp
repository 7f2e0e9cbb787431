#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

#include "idl/codec/fastdds/mission.hpp"
#include "idl/codec/fastdds/plan.hpp"
#include "idl/codec/fastdds/status.hpp"
#include "idl/codec/fastdds/vehicle.hpp"
#include "idl/codec/fastdds/world.hpp"
#include "tests/unit/idl/samples.hpp"

namespace swallowtail {
namespace {

template <class T>
struct WireOf;
#define WIRE_OF(type)                    \
  template <>                            \
  struct WireOf<data::type> {            \
    using Wire = swallowtail_wire::type; \
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

/// Through the wire sample and the bytes of the wire.
template <class T>
T round_trip(const T& sample) {
  using Wire = typename WireOf<T>::Wire;
  Wire out;
  codec::fast::to_wire(sample, out);
  std::vector<char> bytes(Wire::getCdrSerializedSize(out) + 8);
  eprosima::fastcdr::FastBuffer buffer(bytes.data(), bytes.size());
  eprosima::fastcdr::Cdr writer(buffer);
  out.serialize(writer);
  eprosima::fastcdr::Cdr reader(buffer);
  Wire in;
  in.deserialize(reader);
  T back;
  EXPECT_EQ(codec::fast::to_data(in, back), data::Refusal{});
  return back;
}

TEST(FastCodec, KeepsEveryFieldOfEveryType) {
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

TEST(FastCodec, ReusesTheWireSampleForShorterAndLongerContent) {
  testing::for_each_type([](auto type) {
    using T = decltype(type);
    typename WireOf<T>::Wire wire;
    T back;
    for (const auto extent : {testing::Extent::kFull, testing::Extent::kEmpty, testing::Extent::kRandom}) {
      const T sample = testing::make_sample<T>(extent, 11);
      codec::fast::to_wire(sample, wire);
      EXPECT_EQ(codec::fast::to_data(wire, back), data::Refusal{});
      EXPECT_TRUE(back == sample);
    }
  });
}

TEST(FastCodec, RefusesEnumeratorsThatDoNotExist) {
  data::Obstacle value;
  swallowtail_wire::Obstacle wire;
  wire.shape() = static_cast<swallowtail_wire::ObstacleShape>(5);
  EXPECT_EQ(codec::fast::to_data(wire, value), codec::fast::kBadEnumerator);
  data::CoveragePlan plan;
  swallowtail_wire::CoveragePlan plan_wire;
  plan_wire.legs().resize(2);
  plan_wire.legs()[0].kind() = swallowtail_wire::LEG_COVER;
  plan_wire.legs()[0].transfer() = swallowtail_wire::TRANSFER_F_F;
  plan_wire.legs()[1].kind() = static_cast<swallowtail_wire::LegKind>(0x80000000u);
  EXPECT_EQ(codec::fast::to_data(plan_wire, plan), codec::fast::kBadEnumerator);
}

TEST(FastCodec, RefusesSequencesAboveTheirBounds) {
  data::PathPlan plan;
  swallowtail_wire::PathPlan wire;
  wire.verdict() = swallowtail_wire::VERDICT_CERTIFIED;
  wire.waypoints().resize(data::kMaxWaypoints + 1);
  EXPECT_EQ(codec::fast::to_data(wire, plan), codec::fast::kTooLong);
}

}  // namespace
}  // namespace swallowtail
