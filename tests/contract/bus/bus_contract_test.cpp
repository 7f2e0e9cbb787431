#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "qos/cyclone/bus.hpp"
#include "qos/fastdds/bus.hpp"
#include "qos/memory/bus.hpp"
#include "tests/contract/bus/probe.hpp"
#include "tests/unit/idl/samples.hpp"

// What every form of the bus must do. Each test has a network of its own: domains 20 to 59.
namespace swallowtail {
namespace {

using testing::Extent;
using testing::make_sample;
using testing::Probe;

enum class Form { kMemory, kFast, kCyclone };

class BusContract : public ::testing::TestWithParam<Form> {
 protected:
  std::unique_ptr<Bus> make_bus() {
    if (GetParam() == Form::kMemory) return network_.make_bus();
    const BusOptions options{.domain = domain_, .participant_name = "contract"};
    auto bus = GetParam() == Form::kFast ? make_fast_bus(options) : make_cyclone_bus(options);
    EXPECT_TRUE(bus.ok()) << bus.error().message;
    return std::move(*bus);
  }

 private:
  static std::uint32_t next_domain() {
    static std::uint32_t last = 19;
    return ++last;
  }

  MemoryNetwork network_;
  std::uint32_t domain_ = next_domain();
};

template <class T>
std::unique_ptr<Publisher<T>> open(Bus& bus, std::int32_t strength = 10) {
  auto publisher = bus.publisher<T>({.ownership_strength = strength});
  EXPECT_TRUE(publisher.ok()) << publisher.error().message;
  return std::move(*publisher);
}

/// Publishes until the first sample has come through: a best-effort or volatile topic has no memory of what
/// came before the match.
template <class T>
bool publish_until_heard(Publisher<T>& publisher, const T& sample, Probe<T>& probe) {
  for (int i = 0; i < 400; ++i) {
    EXPECT_TRUE(publisher.publish(sample).ok());
    if (probe.wait_for_samples(1, std::chrono::milliseconds(20))) return true;
  }
  return false;
}

TEST_P(BusContract, CarriesEveryTypeUnchanged) {
  const auto writer = make_bus();
  testing::for_each_type([&](auto type) {
    using T = decltype(type);
    Probe<T> probe;
    const auto reader = make_bus();
    ASSERT_TRUE(reader->subscribe<T>(probe.handlers()).ok());
    const auto publisher = open<T>(*writer);
    const T sample = make_sample<T>(Extent::kRandom, 5);
    ASSERT_TRUE(publish_until_heard(*publisher, sample, probe)) << TopicOf<T>::qos.name;
    EXPECT_TRUE(probe.samples().front() == sample) << TopicOf<T>::qos.name;
    EXPECT_GE(reader->statistics().accepted, 1u);
    EXPECT_TRUE(reader->statistics().rejected.empty());
  });
}

TEST_P(BusContract, GivesLateJoinersTheLastSampleOfEachInstance) {
  Probe<data::Obstacle> probe;
  const auto writer = make_bus();
  const auto publisher = open<data::Obstacle>(*writer);
  data::Obstacle obstacle = make_sample<data::Obstacle>(Extent::kEmpty, 1);
  for (std::uint32_t round = 1; round <= 3; ++round) {
    for (std::uint32_t id = 1; id <= 5; ++id) {
      obstacle.obstacle_id = id;
      obstacle.revision = round;
      ASSERT_TRUE(publisher->publish(obstacle).ok());
    }
  }
  const auto reader = make_bus();
  ASSERT_TRUE(reader->subscribe<data::Obstacle>(probe.handlers()).ok());
  ASSERT_TRUE(probe.wait_for_samples(5));
  std::uint32_t ids = 0;
  for (const data::Obstacle& sample : probe.samples()) {
    EXPECT_EQ(sample.revision, 3u);
    ids |= 1u << sample.obstacle_id;
  }
  EXPECT_EQ(ids, 0b111110u);
}

TEST_P(BusContract, TellsWhichInstanceIsGone) {
  Probe<data::Obstacle> obstacles;
  Probe<data::TerrainTile> tiles;
  const auto reader = make_bus();
  const auto writer = make_bus();
  ASSERT_TRUE(reader->subscribe<data::Obstacle>(obstacles.handlers()).ok());
  ASSERT_TRUE(reader->subscribe<data::TerrainTile>(tiles.handlers()).ok());
  const auto obstacle_out = open<data::Obstacle>(*writer);
  const auto tile_out = open<data::TerrainTile>(*writer);
  auto obstacle = make_sample<data::Obstacle>(Extent::kEmpty, 1);
  for (const std::uint32_t id : {1u, 65536u, 0xdeadbeefu}) {
    obstacle.obstacle_id = id;
    ASSERT_TRUE(obstacle_out->publish(obstacle).ok());
  }
  const auto tile = make_sample<data::TerrainTile>(Extent::kRandom, 2);
  ASSERT_TRUE(tile_out->publish(tile).ok());
  ASSERT_TRUE(obstacles.wait_for_samples(3));
  ASSERT_TRUE(tiles.wait_for_samples(1));
  EXPECT_TRUE(obstacles.gone().empty());
  for (const std::uint32_t id : {65536u, 0xdeadbeefu, 1u}) {
    obstacle.obstacle_id = id;
    ASSERT_TRUE(obstacle_out->dispose(obstacle).ok());
    EXPECT_TRUE(obstacles.wait_for_gone({id, 0, 0})) << id;
  }
  ASSERT_TRUE(tile_out->dispose(tile).ok());
  EXPECT_TRUE(tiles.wait_for_gone({tile.map_id, tile.row, tile.col}));
  EXPECT_EQ(obstacles.gone().size(), 3u) << "each once";
  EXPECT_EQ(obstacles.samples().size(), 3u) << "a dispose is not a sample";
}

TEST_P(BusContract, AnInstanceThatIsGoneMayComeBack) {
  Probe<data::Obstacle> probe;
  const auto reader = make_bus();
  const auto writer = make_bus();
  ASSERT_TRUE(reader->subscribe<data::Obstacle>(probe.handlers()).ok());
  const auto publisher = open<data::Obstacle>(*writer);
  auto obstacle = make_sample<data::Obstacle>(Extent::kEmpty, 1);
  for (std::size_t round = 1; round <= 3; ++round) {
    obstacle.revision = static_cast<std::uint32_t>(round);
    ASSERT_TRUE(publisher->publish(obstacle).ok());
    ASSERT_TRUE(probe.wait_for_samples(round)) << round;
    ASSERT_TRUE(publisher->dispose(obstacle).ok());
    ASSERT_TRUE(probe.wait([&](const auto&, const auto& gone) { return gone.size() == round; })) << round;
  }
}

TEST_P(BusContract, ReportsInstancesOfAWriterThatLeaves) {
  Probe<data::ChargerState> probe;
  const auto reader = make_bus();
  auto writer = make_bus();
  ASSERT_TRUE(reader->subscribe<data::ChargerState>(probe.handlers()).ok());
  auto publisher = open<data::ChargerState>(*writer);
  const auto state = make_sample<data::ChargerState>(Extent::kRandom, 1);
  ASSERT_TRUE(publish_until_heard(*publisher, state, probe));
  publisher.reset();
  writer.reset();
  EXPECT_TRUE(probe.wait_for_gone({state.charger_id, 0, 0}));
}

TEST_P(BusContract, HearsTheStrongerOwnerOnlyAndTheWeakerAfterIt) {
  Probe<data::PathPlan> probe;
  const auto reader = make_bus();
  const auto strong_bus = make_bus();
  const auto weak_bus = make_bus();
  ASSERT_TRUE(reader->subscribe<data::PathPlan>(probe.handlers()).ok());
  auto strong = open<data::PathPlan>(*strong_bus, 10);
  const auto weak = open<data::PathPlan>(*weak_bus, 5);
  auto plan = make_sample<data::PathPlan>(Extent::kEmpty, 1);
  plan.vehicle_id = 1;
  plan.revision = 10;
  ASSERT_TRUE(publish_until_heard(*strong, plan, probe));
  const auto heard = [&](std::uint32_t revision) {
    return probe.wait([&](const auto& samples,
                          const auto&) { return !samples.empty() && samples.back().revision == revision; },
                      std::chrono::milliseconds(20));
  };
  for (std::uint32_t i = 0; i < 30; ++i) {
    plan.revision = 5;
    ASSERT_TRUE(weak->publish(plan).ok());
    plan.revision = 11 + i;
    ASSERT_TRUE(strong->publish(plan).ok());
    for (int tries = 0; tries < 100 && !heard(plan.revision); ++tries) strong->assert_liveliness();
  }
  for (const data::PathPlan& sample : probe.samples()) EXPECT_NE(sample.revision, 5u);
  strong.reset();
  bool took_over = false;
  for (int tries = 0; tries < 100 && !took_over; ++tries) {
    plan.revision = 5;
    ASSERT_TRUE(weak->publish(plan).ok());
    took_over = heard(5);
  }
  EXPECT_TRUE(took_over);
}

TEST_P(BusContract, RefusesToPublishWhatIsNotValid) {
  Probe<data::BatteryState> probe;
  const auto bus = make_bus();
  ASSERT_TRUE(bus->subscribe<data::BatteryState>(probe.handlers()).ok());
  const auto publisher = open<data::BatteryState>(*bus);
  auto state = make_sample<data::BatteryState>(Extent::kRandom, 1);
  state.energy = 2.0 * state.capacity;
  const Status status = publisher->publish(state);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("energy above capacity"), std::string::npos)
      << status.error().message;
  EXPECT_EQ(status.error().code, Error::Code::kBadInput);
  state.energy = state.capacity;
  ASSERT_TRUE(publish_until_heard(*publisher, state, probe));
  EXPECT_TRUE(probe.samples().front() == state) << "nothing came before the valid sample";
}

TEST_P(BusContract, CountsRejectionsByTopicAndReason) {
  const auto bus = make_bus();
  for (int i = 0; i < 3; ++i) bus->count_rejection("BatteryState", "above the task's capacity");
  bus->count_rejection("VehicleState", "unknown vehicle");
  const BusStatistics statistics = bus->statistics();
  ASSERT_EQ(statistics.rejected.size(), 2u);
  EXPECT_EQ(statistics.rejected[0], (data::Rejection{"BatteryState", "above the task's capacity", 3}));
  EXPECT_EQ(statistics.rejected[1], (data::Rejection{"VehicleState", "unknown vehicle", 1}));
  EXPECT_EQ(statistics.accepted, 0u);
}

TEST_P(BusContract, HearsItself) {
  Probe<data::Goal> probe;
  const auto bus = make_bus();
  ASSERT_TRUE(bus->subscribe<data::Goal>(probe.handlers()).ok());
  const auto publisher = open<data::Goal>(*bus);
  const auto goal = make_sample<data::Goal>(Extent::kRandom, 1);
  EXPECT_TRUE(publish_until_heard(*publisher, goal, probe));
}

TEST_P(BusContract, RunsNoHandlerAfterItsEnd) {
  const auto writer = make_bus();
  const auto publisher = open<data::MissionClock>(*writer);
  std::atomic<bool> is_over = false;
  std::atomic<int> late = 0;
  std::atomic<int> heard = 0;
  for (int round = 0; round < 3; ++round) {
    is_over = false;
    auto reader = make_bus();
    ASSERT_TRUE(reader
                    ->subscribe<data::MissionClock>({.on_sample =
                                                         [&](const auto&) {
                                                           ++heard;
                                                           if (is_over) ++late;
                                                         }})
                    .ok());
    const int before = heard;
    for (int i = 0; i < 4000 && heard == before; ++i) {
      ASSERT_TRUE(publisher->publish({.time_s = 1.0 * i}).ok());
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // a pace for the wire, not a wait for it
    }
    EXPECT_GT(heard, before);
    reader.reset();
    is_over = true;
    for (int i = 0; i < 50; ++i) ASSERT_TRUE(publisher->publish({.time_s = 1.0 * i}).ok());
  }
  EXPECT_EQ(late, 0);
}

INSTANTIATE_TEST_SUITE_P(Forms, BusContract, ::testing::Values(Form::kMemory, Form::kFast, Form::kCyclone),
                         [](const auto& form) {
                           return std::string(form.param == Form::kMemory ? "Memory"
                                              : form.param == Form::kFast ? "Fast"
                                                                          : "Cyclone");
                         });

}  // namespace
}  // namespace swallowtail
