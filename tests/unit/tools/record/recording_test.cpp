#include "tools/record/recording/recording.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include "qos/fastdds/wire.hpp"
#include "tests/unit/tools/record/mcap_fixture.hpp"

namespace swallowtail::recording {
namespace {

class RecordingTest : public mcap::McapTest {
 protected:
  template <class T>
  static std::string payload_of(const T& value) {
    const auto wire = std::make_unique<typename fast::WireOf<T>::Wire>();
    codec::fast::to_wire(value, *wire);
    eprosima::fastcdr::FastBuffer buffer;
    eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN,
                               eprosima::fastcdr::Cdr::DDS_CDR);
    cdr.serialize_encapsulation();
    wire->serialize(cdr);
    return {buffer.getBuffer(), cdr.getSerializedDataLength()};
  }

  /// One file with these messages on these topics, in this order.
  void write(const std::vector<std::pair<std::string, std::string>>& messages) const {
    auto writer = mcap::Writer::create(file("a.mcap"));
    ASSERT_TRUE(writer.ok());
    std::uint32_t n = 0;
    for (const auto& [topic, data] : messages) {
      const auto channel =
          writer->add_channel(0, topic, topic.find('#') == std::string::npos ? "cdr" : "json");
      ++n;
      ASSERT_TRUE(put(*writer, *channel, {topic, n, 100u + n, 50u + n, data}).ok());
    }
    ASSERT_TRUE(writer->finish().ok());
  }

  static data::Obstacle obstacle() {
    data::Obstacle o;
    o.obstacle_id = 9;
    o.radius_m = 12.0;
    o.position = {400.0, 300.0, 30.0};
    return o;
  }
};

TEST_F(RecordingTest, GivesPlainValuesWithTheirTimes) {
  data::VehicleState state;
  state.vehicle_id = 1;
  state.position = {1.0, 2.0, 3.0};
  write({{"VehicleState", payload_of(state)},
         {"Obstacle", payload_of(obstacle())},
         {"Obstacle#lifecycle", R"({"kind":"dispose","key":9,"key_hex":"00000009"})"},
         {"TerrainTile#lifecycle", R"({"kind":"unregister","key":[1,2,3],"key_hex":""})"}});
  const auto recording = load_recording(file("a.mcap"));
  ASSERT_TRUE(recording.ok()) << recording.error().message;
  ASSERT_EQ(recording->vehicle_states.size(), 1u);
  EXPECT_EQ(recording->vehicle_states[0].value, state);
  EXPECT_EQ(recording->vehicle_states[0].log_time_ns, 101u);
  EXPECT_EQ(recording->vehicle_states[0].publish_time_ns, 51u);
  ASSERT_EQ(recording->obstacles.size(), 1u);
  EXPECT_EQ(recording->obstacles[0].value, obstacle());
  ASSERT_EQ(recording->endings.size(), 2u);
  EXPECT_EQ(recording->endings[0].value.topic, "Obstacle");
  EXPECT_EQ(recording->endings[0].value.key, (InstanceKey{9, 0, 0}));
  EXPECT_TRUE(recording->endings[0].value.is_disposed);
  EXPECT_EQ(recording->endings[1].value.key, (InstanceKey{1, 2, 3}));
  EXPECT_FALSE(recording->endings[1].value.is_disposed);
  EXPECT_TRUE(recording->is_complete);
  EXPECT_TRUE(recording->refused.empty());
}

TEST_F(RecordingTest, CountsWhatParticipantsWouldRefuse) {
  data::Obstacle bad = obstacle();
  bad.position.x_m = std::numeric_limits<double>::quiet_NaN();
  std::string bad_enumerator = payload_of(obstacle());
  bad_enumerator[4 + 8] = 99;
  std::string appendable = payload_of(obstacle());
  appendable[1] = 9;
  write({{"Obstacle", payload_of(bad)},
         {"Obstacle", bad_enumerator},
         {"Obstacle", appendable},
         {"Obstacle", "x"},
         {"Obstacle", payload_of(obstacle()).substr(0, 40)},
         {"Obstacle", payload_of(obstacle())},
         {"Rumour", "x"},
         {"Obstacle#lifecycle", "{"},
         {"Obstacle#lifecycle", R"({"kind":"dispose","key":-1})"},
         {"Obstacle#lifecycle", R"({"kind":"dispose","key":[1,2,3,4]})"}});
  const auto recording = load_recording(file("a.mcap"));
  ASSERT_TRUE(recording.ok());
  EXPECT_EQ(recording->obstacles.size(), 1u);
  EXPECT_TRUE(recording->endings.empty());
  EXPECT_EQ(recording->refused.at("Obstacle: position out of range"), 1u);
  EXPECT_EQ(recording->refused.at("Obstacle: enumerator out of range"), 1u);
  EXPECT_EQ(recording->refused.at("Obstacle: not plain CDR"), 2u);
  EXPECT_EQ(recording->refused.at("Obstacle: malformed CDR"), 1u);
  EXPECT_EQ(recording->refused.at("Obstacle#lifecycle: no lifecycle event"), 3u);
  EXPECT_EQ(recording->unknown.at("Rumour"), 1u);
}

TEST_F(RecordingTest, ASequenceThatIsLongerThanItsBytesIsRefused) {
  std::string payload = payload_of(obstacle());
  const std::uint32_t huge = 0xFFFFFFFFu;
  std::memcpy(payload.data() + payload.size() - sizeof huge, &huge, sizeof huge);
  write({{"Obstacle", payload}});
  const auto recording = load_recording(file("a.mcap"));
  ASSERT_TRUE(recording.ok());
  EXPECT_EQ(recording->refused.at("Obstacle: malformed CDR"), 1u);
}

TEST_F(RecordingTest, AFileCutShortGivesWhatIsInIt) {
  write({{"Obstacle", payload_of(obstacle())}});
  put_bytes(file("cut.mcap"), bytes_of(file("a.mcap")).substr(0, bytes_of(file("a.mcap")).size() - 20));
  const auto recording = load_recording(file("cut.mcap"));
  ASSERT_TRUE(recording.ok());
  EXPECT_FALSE(recording->is_complete);
  EXPECT_FALSE(recording->problems.empty());
  EXPECT_EQ(recording->obstacles.size(), 1u);
  EXPECT_FALSE(load_recording(file("none.mcap")).ok());
}

}  // namespace
}  // namespace swallowtail::recording
