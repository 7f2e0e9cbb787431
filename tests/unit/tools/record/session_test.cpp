#include "tools/record/session.hpp"

#include <sys/resource.h>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/unit/tools/record/mcap_fixture.hpp"
#include "tools/record/contract.hpp"

namespace swallowtail::record {
namespace {

using mcap::McapTest;
using mcap::Reader;

constexpr std::size_t kVehicleState = 0;
constexpr std::size_t kTerrainTile = 1;

class SessionTest : public McapTest {
 protected:
  static std::vector<TopicQos> topics() { return {*find_topic("VehicleState"), *find_topic("TerrainTile")}; }

  /// A payload of `size` bytes which frees itself.
  static Payload payload(std::string text) {
    auto* owned = new std::string(std::move(text));
    return {std::as_bytes(std::span(*owned)), owned,
            [](void* owner) { delete static_cast<std::string*>(owner); }};
  }
  static Event sample(std::size_t topic, std::uint64_t time_ns, std::string text) {
    Event event;
    event.topic = topic;
    event.vendor = Vendor::kFastDds;
    event.log_time_ns = time_ns;
    event.publish_time_ns = time_ns - 1;
    event.payload = payload(std::move(text));
    return event;
  }
  static Event ending(std::size_t topic, std::uint64_t time_ns, EventKind kind, InstanceKey key) {
    Event event;
    event.topic = topic;
    event.kind = kind;
    event.log_time_ns = time_ns;
    event.key = key;
    return event;
  }
};

TEST(Contract, EveryTopicHasTheIdlOfItsType) {
  for (const TopicQos& topic : kTopics) {
    const std::string idl(contract_idl(topic.type_name));
    EXPECT_NE(idl.find("struct " + std::string(topic.name) + " {"), std::string::npos) << topic.name;
    EXPECT_NE(idl.find("module swallowtail {"), std::string::npos) << topic.name;
    EXPECT_EQ(idl.find('#'), std::string::npos) << topic.name << ": a preprocessor line is left";
    EXPECT_EQ(idl.find("//"), std::string::npos) << topic.name << ": a comment is left";
  }
  EXPECT_TRUE(contract_idl("swallowtail::Nothing").empty());
  EXPECT_EQ(find_topic("Nothing"), nullptr);
}

TEST_F(SessionTest, PutsSamplesAndEndingsOnChannelsOfTheirOwn) {
  auto session = Session::start(file("a.mcap"), topics(), {});
  ASSERT_TRUE(session.ok()) << session.error().message;
  (*session)->record(sample(kVehicleState, 10, "first"));
  (*session)->record(sample(kTerrainTile, 11, "tile"));
  (*session)->record(sample(kVehicleState, 12, "second"));
  (*session)->record(ending(kTerrainTile, 13, EventKind::kDispose, {1, 2, 0x00ABCDEF}));
  (*session)->record(ending(kVehicleState, 14, EventKind::kUnregister, {7}));
  (*session)->count_lost(kVehicleState, 3);
  const auto summary = (*session)->finish();
  ASSERT_TRUE(summary.ok());
  EXPECT_EQ(summary->messages, 5u);
  EXPECT_EQ(summary->topics[kVehicleState].samples, 2u);
  EXPECT_EQ(summary->topics[kVehicleState].lost, 3u);

  const auto reader = Reader::open(file("a.mcap"));
  ASSERT_TRUE(reader.ok());
  const auto samples = samples_of(*reader);
  ASSERT_EQ(samples.size(), 5u);
  EXPECT_EQ(samples[0], (mcap::Sample{"VehicleState", 1, 10, 9, "first"}));
  EXPECT_EQ(samples[2], (mcap::Sample{"VehicleState", 2, 12, 11, "second"}));
  EXPECT_EQ(samples[3].topic, "TerrainTile#lifecycle");
  EXPECT_EQ(samples[3].data,
            R"({"key":[1,2,11259375],"key_hex":"000000010000000200abcdef","kind":"dispose"})");
  EXPECT_EQ(samples[4].data, R"({"key":7,"key_hex":"00000007","kind":"unregister"})");
  const auto& channel = reader->channels()[0];
  EXPECT_EQ(channel.metadata.at("reliability"), "best_effort");
  EXPECT_EQ(channel.metadata.at("first_writer_vendor"), "eProsima Fast DDS");
  EXPECT_EQ(reader->find_schema(channel.schema_id)->name, "swallowtail::VehicleState");
  EXPECT_EQ(reader->find_schema(channel.schema_id)->encoding, "omgidl");
  ASSERT_EQ(reader->metadata().size(), 1u);
  const auto counters = nlohmann::json::parse(reader->metadata()[0].entries.at("VehicleState"));
  EXPECT_EQ(counters["received"], 2);
  EXPECT_EQ(counters["lost"], 3);
  EXPECT_EQ(counters["by_vendor"]["eProsima Fast DDS"], 2);
}

TEST_F(SessionTest, WritesAllThatManyThreadsHandOver) {
  auto session = Session::start(file("a.mcap"), topics(), {});
  ASSERT_TRUE(session.ok());
  constexpr int kThreads = 4;
  constexpr std::uint64_t kEach = 5000;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&] {
      for (std::uint64_t i = 1; i <= kEach; ++i) (*session)->record(sample(kVehicleState, i, "sample"));
    });
  }
  for (auto& thread : threads) thread.join();
  const auto summary = (*session)->finish();
  ASSERT_TRUE(summary.ok());
  EXPECT_EQ(summary->topics[kVehicleState].samples, kThreads * kEach);
  EXPECT_EQ(summary->topics[kVehicleState].dropped, 0u);
  const auto reader = Reader::open(file("a.mcap"));
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(samples_of(*reader).size(), kThreads * kEach);
}

TEST_F(SessionTest, AFileThatCannotGrowIsReportedAndWhatFollowsIsCounted) {
  SessionParams params;
  params.file.compression = mcap::Compression::kNone;
  params.file.chunk_bytes = 4096;
  auto session = Session::start(file("a.mcap"), topics(), params);
  ASSERT_TRUE(session.ok());
  struct rlimit before {};
  getrlimit(RLIMIT_FSIZE, &before);
  const struct rlimit small { 20'000, before.rlim_max };
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  std::uint64_t sent = 0;
  while ((*session)->failure().ok() && sent < 1'000'000)
    (*session)->record(sample(kVehicleState, ++sent, std::string(100, 'x')));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  const Status failure = (*session)->failure();
  ASSERT_FALSE(failure.ok());
  EXPECT_NE(failure.error().message.find("a.mcap"), std::string::npos) << failure.error().message;
  EXPECT_FALSE((*session)->finish().ok());
  const auto reader = Reader::open(file("a.mcap"));
  ASSERT_TRUE(reader.ok());
  const auto samples = samples_of(*reader);
  EXPECT_GT(samples.size(), 50u);
  EXPECT_LE(std::filesystem::file_size(file("a.mcap")), 20'000u);
}

TEST_F(SessionTest, RefusesParametersThatCannotWork) {
  SessionParams params;
  params.queue_events = 0;
  EXPECT_FALSE(Session::start(file("a.mcap"), topics(), params).ok());
  const auto nowhere = Session::start(file("no/folder/a.mcap"), topics(), {});
  ASSERT_FALSE(nowhere.ok());
  EXPECT_EQ(nowhere.error().code, Error::Code::kBadInput);
}

TEST(EventQueue, RefusesMoreThanItsBoundsAndGivesBackTheRest) {
  const auto event = [](const std::string& text) {
    Event e;
    e.payload = Payload(std::as_bytes(std::span(text)), nullptr, nullptr);
    return e;
  };
  const std::string ten(10, 'x');
  EventQueue bytes(25, 100);
  EXPECT_TRUE(bytes.push(event(ten)));
  EXPECT_TRUE(bytes.push(event(ten)));
  EXPECT_FALSE(bytes.push(event(ten))) << "30 bytes are more than 25";
  EventQueue events(1000, 2);
  EXPECT_TRUE(events.push(event(ten)));
  EXPECT_TRUE(events.push(event(ten)));
  EXPECT_FALSE(events.push(event(ten))) << "2 events are all";
  std::vector<Event> taken;
  EXPECT_TRUE(events.take_all(taken, std::chrono::seconds(0)));
  EXPECT_EQ(taken.size(), 2u);
  EXPECT_TRUE(events.push(event(ten))) << "there is room again";
  events.close();
  EXPECT_FALSE(events.push(event(ten))) << "closed";
  EXPECT_TRUE(events.take_all(taken, std::chrono::seconds(0))) << "what was there still comes out";
  EXPECT_FALSE(events.take_all(taken, std::chrono::seconds(0)));
  EventQueue large(5, 100);
  EXPECT_TRUE(large.push(event(ten))) << "one that is larger than the queue still goes through an empty one";
}

TEST(Payload, IsReleasedOnce) {
  int released = 0;
  const auto release = [](void* owner) { ++*static_cast<int*>(owner); };
  {
    Payload first({}, &released, release);
    Payload second(std::move(first));
    Payload third;
    third = std::move(second);
    EXPECT_EQ(released, 0);
  }
  EXPECT_EQ(released, 1);
}

}  // namespace
}  // namespace swallowtail::record
