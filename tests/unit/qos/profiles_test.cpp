#include <gtest/gtest.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include "qos/fastdds/participant.hpp"
#include "qos/fastdds/qos.hpp"

// The XML profiles that other programs load, as Fast DDS reads them, against qos/topics.hpp. Domain 100.
namespace swallowtail {
namespace {

namespace dds = eprosima::fastdds::dds;

class Profiles : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(dds::DomainParticipantFactory::get_instance()->load_XML_profiles_file(
                  SWALLOWTAIL_SOURCE_DIR "/qos/profiles/fastdds.xml"),
              ReturnCode_t::RETCODE_OK);
    auto made = fast::Participant::create({.domain = 100});
    ASSERT_TRUE(made.ok()) << made.error().message;
    participant_ = std::move(*made);
  }

  template <class Qos>
  static void expect_equal(const Qos& profile, const Qos& table, const char* topic) {
    EXPECT_TRUE(profile.reliability().kind == table.reliability().kind) << topic;
    EXPECT_TRUE(profile.durability() == table.durability()) << topic;
    EXPECT_TRUE(profile.ownership() == table.ownership()) << topic;
    EXPECT_TRUE(profile.history() == table.history()) << topic;
    EXPECT_TRUE(profile.deadline() == table.deadline()) << topic;
    EXPECT_TRUE(profile.lifespan() == table.lifespan()) << topic;
    EXPECT_TRUE(profile.liveliness() == table.liveliness()) << topic;
    EXPECT_TRUE(profile.resource_limits() == table.resource_limits()) << topic;
    EXPECT_TRUE(profile.data_sharing().kind() == table.data_sharing().kind()) << topic;
    EXPECT_EQ(profile.endpoint().history_memory_policy, table.endpoint().history_memory_policy) << topic;
  }

  std::unique_ptr<fast::Participant> participant_;
};

TEST_F(Profiles, OfWritersAndReadersEqualTheTable) {
  for (const TopicQos& row : kTopics) {
    dds::DataWriterQos writer;
    ASSERT_EQ(participant_->publisher()->get_datawriter_qos_from_profile(row.name, writer),
              ReturnCode_t::RETCODE_OK);
    const auto writer_table = fast::writer_qos(row, 0);
    expect_equal(writer, writer_table, row.name);
    EXPECT_EQ(writer.publish_mode().kind, writer_table.publish_mode().kind) << row.name;
    if (row.reliability == Reliability::kReliable) {
      EXPECT_TRUE(writer.reliable_writer_qos().times.heartbeatPeriod ==
                  writer_table.reliable_writer_qos().times.heartbeatPeriod)
          << row.name;
    }
    dds::DataReaderQos reader;
    ASSERT_EQ(participant_->subscriber()->get_datareader_qos_from_profile(row.name, reader),
              ReturnCode_t::RETCODE_OK);
    expect_equal(reader, fast::reader_qos(row), row.name);
  }
}

TEST_F(Profiles, OfTheParticipantStayOnTheLoopback) {
  for (const char* name : {"swallowtail", "swallowtail_shm"}) {
    dds::DomainParticipantQos qos;
    ASSERT_EQ(dds::DomainParticipantFactory::get_instance()->get_participant_qos_from_profile(name, qos),
              ReturnCode_t::RETCODE_OK);
    EXPECT_FALSE(qos.transport().use_builtin_transports);
    const auto& builtin = qos.wire_protocol().builtin;
    ASSERT_EQ(builtin.initialPeersList.size(), 1u);
    EXPECT_EQ(eprosima::fastrtps::rtps::IPLocator::toIPv4string(*builtin.initialPeersList.begin()),
              "127.0.0.1");
    EXPECT_EQ(builtin.metatrafficMulticastLocatorList.size(), 0u);
    EXPECT_EQ(builtin.metatrafficUnicastLocatorList.size(), 1u);
    EXPECT_EQ(builtin.discovery_config.leaseDuration_announcementperiod.to_ns(), 200'000'000);
  }
}

TEST(Table, IsConsistent) {
  for (const TopicQos& row : kTopics) {
    EXPECT_EQ(std::string("swallowtail::") + row.name, row.type_name);
    EXPECT_LE(row.deadline_offered_ms, row.deadline_requested_ms) << row.name << ": else nothing matches";
    EXPECT_EQ(row.deadline_offered_ms == 0, row.deadline_requested_ms == 0) << row.name;
    EXPECT_EQ(row.ownership == Ownership::kExclusive, row.lease_ms > 0)
        << row.name << ": failover rests on the lease";
    if (row.lease_ms > 0 && row.deadline_requested_ms > 0) {
      EXPECT_GT(row.deadline_requested_ms, 10 * row.lease_ms);
    }
    EXPECT_GE(row.max_instances, 1) << row.name;
    EXPECT_LE(row.key_fields, 3) << row.name;
  }
}

}  // namespace
}  // namespace swallowtail
