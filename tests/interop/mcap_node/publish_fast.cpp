// Fast DDS test publisher: publish_fast DOMAIN BASE [STATES TILES]
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "idl/codec/fastdds/mission.hpp"
#include "idl/codec/fastdds/plan.hpp"
#include "idl/codec/fastdds/status.hpp"
#include "idl/codec/fastdds/vehicle.hpp"
#include "idl/codec/fastdds/world.hpp"
#include "tests/interop/mcap_node/scenario.hpp"
#define swallowtail swallowtail_wire
#include "missionPubSubTypes.h"
#include "planPubSubTypes.h"
#include "statusPubSubTypes.h"
#include "vehiclePubSubTypes.h"
#include "worldPubSubTypes.h"
#undef swallowtail

namespace swallowtail::record_test {
namespace {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::Duration_t;

dds::DomainParticipant* make_participant(std::uint32_t domain) {
  dds::DomainParticipantQos qos;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList.emplace_back("127.0.0.1");
  udp->maxInitialPeersRange = 12;
  udp->sendBufferSize = udp->receiveBufferSize = 4 << 20;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  eprosima::fastrtps::rtps::Locator_t peer;
  peer.kind = LOCATOR_KIND_UDPv4;
  eprosima::fastrtps::rtps::IPLocator::setIPv4(peer, "127.0.0.1");
  qos.wire_protocol().builtin.initialPeersList.push_back(peer);
  return dds::DomainParticipantFactory::get_instance()->create_participant(domain, qos);
}

class FastOut {
 public:
  explicit FastOut(std::uint32_t domain) : participant_(make_participant(domain)) {}
  ~FastOut() {
    if (participant_ == nullptr) return;
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  Status prepare() {
    if (participant_ == nullptr) return internal_error("no participant");
    publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    make<swallowtail_wire::VehicleStatePubSubType>("VehicleState");
    make<swallowtail_wire::MissionClockPubSubType>("MissionClock");
    make<swallowtail_wire::TerrainTilePubSubType>("TerrainTile");
    make<swallowtail_wire::ObstaclePubSubType>("Obstacle");
    make<swallowtail_wire::CoverageTaskPubSubType>("CoverageTask");
    make<swallowtail_wire::CoveragePlanPubSubType>("CoveragePlan");
    make<swallowtail_wire::ChargerPlanPubSubType>("ChargerPlan");
    make<swallowtail_wire::PathPlanPubSubType>("PathPlan");
    make<swallowtail_wire::ChargerStatePubSubType>("ChargerState");
    make<swallowtail_wire::ParticipantStatusPubSubType>("ParticipantStatus");
    make<swallowtail_wire::BatteryStatePubSubType>("BatteryState");
    make<swallowtail_wire::GoalPubSubType>("Goal");
    for (int tries = 0; tries < 1000; ++tries) {
      bool all = true;
      for (const auto& [name, writer] : writers_) {
        dds::PublicationMatchedStatus status;
        writer->get_publication_matched_status(status);
        all = all && status.current_count > 0;
      }
      if (all) return {};
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return internal_error("no recorder has been found within 10 s");
  }

  void send(const data::VehicleState& v) { put<swallowtail_wire::VehicleState>("VehicleState", v); }
  void send(const data::BatteryState& v) { put<swallowtail_wire::BatteryState>("BatteryState", v); }
  void send(const data::MissionClock& v) { put<swallowtail_wire::MissionClock>("MissionClock", v); }
  void send(const data::TerrainTile& v) { put<swallowtail_wire::TerrainTile>("TerrainTile", v); }
  void send(const data::Obstacle& v) { put<swallowtail_wire::Obstacle>("Obstacle", v); }
  void send(const data::CoverageTask& v) { put<swallowtail_wire::CoverageTask>("CoverageTask", v); }
  void send(const data::CoveragePlan& v) { put<swallowtail_wire::CoveragePlan>("CoveragePlan", v); }
  void send(const data::ChargerPlan& v) { put<swallowtail_wire::ChargerPlan>("ChargerPlan", v); }
  void send(const data::PathPlan& v) { put<swallowtail_wire::PathPlan>("PathPlan", v); }
  void send(const data::ChargerState& v) { put<swallowtail_wire::ChargerState>("ChargerState", v); }
  void send(const data::ParticipantStatus& v) {
    put<swallowtail_wire::ParticipantStatus>("ParticipantStatus", v);
  }
  void send(const data::Goal& v) { put<swallowtail_wire::Goal>("Goal", v); }

  void dispose(const data::Obstacle& last) {
    swallowtail_wire::Obstacle wire;
    codec::fast::to_wire(last, wire);
    writers_.at("Obstacle")->dispose(&wire, {});
  }

  Status sync() {
    for (const auto& [name, writer] : writers_) {
      if (find_topic(name)->reliability != Reliability::kReliable) continue;
      if (writer->wait_for_acknowledgments(Duration_t(20, 0)) != ReturnCode_t::RETCODE_OK) {
        return internal_error("samples of " + name + " have not been acknowledged");
      }
    }
    return {};
  }

 private:
  static const TopicQos* find_topic(const std::string& name) { return record::find_topic(name); }

  template <class Type>
  void make(const std::string& name) {
    const TopicQos& profile = *find_topic(name);
    const dds::TypeSupport type(new Type());
    type.register_type(participant_);
    dds::Topic* topic = participant_->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
    const bool is_reliable = profile.reliability == Reliability::kReliable;
    dds::DataWriterQos qos;
    qos.reliability().kind = is_reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind = profile.durability == Durability::kTransientLocal
                                ? dds::TRANSIENT_LOCAL_DURABILITY_QOS
                                : dds::VOLATILE_DURABILITY_QOS;
    qos.ownership().kind =
        profile.ownership == Ownership::kExclusive ? dds::EXCLUSIVE_OWNERSHIP_QOS : dds::SHARED_OWNERSHIP_QOS;
    qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = 1;
    qos.resource_limits().max_instances = 2000;
    qos.resource_limits().max_samples = 2000;
    qos.resource_limits().max_samples_per_instance = 1;
    qos.reliable_writer_qos().times.heartbeatPeriod = Duration_t(0, 100'000'000);
    if (is_reliable) qos.publish_mode().kind = dds::ASYNCHRONOUS_PUBLISH_MODE;
    qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    writers_[name] = publisher_->create_datawriter(topic, qos);
  }

  template <class Wire, class Data>
  void put(const char* name, const Data& value) {
    const auto wire = std::make_unique<Wire>();
    codec::fast::to_wire(value, *wire);
    if (!writers_.at(name)->write(wire.get()))
      std::cerr << "publish_fast: a sample of " << name << " was refused\n";
  }

  dds::DomainParticipant* participant_;
  dds::Publisher* publisher_ = nullptr;
  std::map<std::string, dds::DataWriter*> writers_;
};

}  // namespace
}  // namespace swallowtail::record_test

int main(int argc, char** argv) {
  using namespace swallowtail::record_test;
  if (argc < 3) return 2;
  Sizes sizes;
  if (argc > 3) sizes.states = static_cast<std::uint32_t>(std::strtoul(argv[3], nullptr, 10));
  if (argc > 4) sizes.tiles = static_cast<std::uint32_t>(std::strtoul(argv[4], nullptr, 10));
  FastOut out(static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)));
  const auto done =
      publish_scenario(out, static_cast<std::uint32_t>(std::strtoul(argv[2], nullptr, 10)), sizes);
  if (!done) std::cerr << "publish_fast: " << done.error().message << '\n';
  return done ? 0 : 1;
}
