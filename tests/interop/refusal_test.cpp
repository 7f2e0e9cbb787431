#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "planner/base/rng.hpp"
#include "qos/cyclone/bus.hpp"
#include "qos/fastdds/bus.hpp"
#include "tests/contract/bus/probe.hpp"
#include "tests/interop/raw_writer.hpp"
#include "tests/unit/idl/samples.hpp"

// What a program that does not keep to the contract may write, and what the buses make of it. Domains 90
// to 99.
namespace swallowtail {
namespace {

using testing::Extent;
using testing::make_sample;
using testing::Probe;
using testing::RawWriter;

std::uint32_t next_domain() {
  static std::uint32_t last = 89;
  return ++last;
}

std::uint64_t count_of(const Bus& bus, const std::string& topic, const std::string& reason) {
  for (const auto& row : bus.statistics().rejected) {
    if (row.topic == topic && row.reason == reason) return row.count;
  }
  return 0;
}

class Refusals : public ::testing::TestWithParam<bool> {
 protected:
  std::unique_ptr<Bus> make_bus() {
    return (GetParam() ? make_fast_bus({.domain = domain_}) : make_cyclone_bus({.domain = domain_})).value();
  }
  const std::uint32_t domain_ = next_domain();
};

/// Writes invalid samples, each as its own instance, then the valid one; the reader must get that alone and
/// count the others by reason.
template <class T>
void expect_refusals(std::unique_ptr<Bus> bus, std::uint32_t domain, const T& valid,
                     const std::vector<std::pair<T, std::string>>& invalid) {
  Probe<T> probe;
  ASSERT_TRUE(bus->subscribe<T>(probe.handlers()).ok());
  RawWriter<T> writer(domain);
  for (const auto& [sample, reason] : invalid) EXPECT_TRUE(writer.write(sample));
  EXPECT_TRUE(writer.write(valid));
  ASSERT_TRUE(probe.wait_for_samples(1));
  EXPECT_TRUE(probe.samples().front() == valid);
  const auto& name = TopicOf<T>::qos.name;
  for (const auto& [sample, reason] : invalid) {
    for (int i = 0; i < 300 && count_of(*bus, name, reason) == 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));  // statistics have no event to wait for
    }
    EXPECT_EQ(count_of(*bus, name, reason), 1u) << reason;
  }
  EXPECT_EQ(probe.samples().size(), 1u);
  EXPECT_EQ(bus->statistics().accepted, 1u);
}

TEST_P(Refusals, ObstaclesThatCannotBe) {
  auto valid = make_sample<data::Obstacle>(Extent::kEmpty, 1);
  valid.obstacle_id = 1;
  auto nan = valid;
  nan.obstacle_id = 2;
  nan.position.x_m = std::numeric_limits<double>::quiet_NaN();
  auto negative = valid;
  negative.obstacle_id = 3;
  negative.radius_m = -1.0;
  auto fast = valid;
  fast.obstacle_id = 4;
  fast.velocity_mps = {300, 0, 0};
  expect_refusals<data::Obstacle>(
      make_bus(), domain_, valid,
      {{nan, "position out of range"}, {negative, "radius out of range"}, {fast, "speed out of range"}});
}

TEST_P(Refusals, TilesOfTheWrongSize) {
  auto valid = make_sample<data::TerrainTile>(Extent::kFull, 1);
  auto short_one = valid;
  short_one.row = 1;
  short_one.elevation_m.pop_back();
  auto hole = valid;
  hole.row = 2;
  hole.elevation_m[77] = std::numeric_limits<float>::quiet_NaN();
  expect_refusals<data::TerrainTile>(
      make_bus(), domain_, valid,
      {{short_one, "tile size differs from its elevations"}, {hole, "elevation out of range"}});
}

TEST_P(Refusals, BatteriesAboveTheirCapacity) {
  auto valid = make_sample<data::BatteryState>(Extent::kRandom, 1);
  auto over = valid;
  over.vehicle_id += 1;
  over.energy = 1.01 * over.capacity;
  expect_refusals<data::BatteryState>(make_bus(), domain_, valid, {{over, "energy above capacity"}});
}

TEST_P(Refusals, RandomBytesNeitherCrashNorBlockTheReader) {
  Probe<data::Obstacle> probe;
  const auto bus = make_bus();
  ASSERT_TRUE(bus->subscribe<data::Obstacle>(probe.handlers()).ok());
  RawWriter<data::Obstacle> writer(domain_);
  Rng rng(20240607);
  for (std::uint32_t i = 0; i < 300; ++i) {
    std::vector<unsigned char> bytes(4 + rng.below(600));
    for (auto& byte : bytes) byte = static_cast<unsigned char>(rng());
    bytes[0] = bytes[2] = bytes[3] = 0;
    bytes[1] = 1;
    EXPECT_TRUE(writer.write(std::move(bytes), {1000 + i, 0, 0}));
  }
  auto valid = make_sample<data::Obstacle>(Extent::kEmpty, 1);
  valid.obstacle_id = 1;
  EXPECT_TRUE(writer.write(valid));
  EXPECT_TRUE(probe.wait([&](const auto& samples, const auto&) {
    return std::find(samples.begin(), samples.end(), valid) != samples.end();
  })) << "seed 20240607";
}

INSTANTIATE_TEST_SUITE_P(Readers, Refusals, ::testing::Bool(),
                         [](const auto& run) { return std::string(run.param ? "Fast" : "Cyclone"); });

}  // namespace
}  // namespace swallowtail
