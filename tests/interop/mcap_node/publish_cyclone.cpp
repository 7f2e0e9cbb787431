// Cyclone DDS test publisher: publish_cyclone DOMAIN BASE [STATES TILES]. Its configuration comes from
// CYCLONEDDS_URI.
#include <dds/dds.h>

#include <cstdlib>
#include <iostream>
#include <map>
#include <string>

#include "idl/codec/cyclone/mission.hpp"
#include "idl/codec/cyclone/plan.hpp"
#include "idl/codec/cyclone/status.hpp"
#include "idl/codec/cyclone/vehicle.hpp"
#include "idl/codec/cyclone/world.hpp"
#include "tests/interop/mcap_node/scenario.hpp"

namespace swallowtail::record_test {
namespace {

class CycloneOut {
 public:
  explicit CycloneOut(std::uint32_t domain)
      : participant_(dds_create_participant(domain, nullptr, nullptr)) {}
  ~CycloneOut() { dds_delete(participant_); }

  Status prepare() {
    if (participant_ < 0) return internal_error("no participant");
    make("VehicleState", swallowtail_VehicleState_desc);
    make("MissionClock", swallowtail_MissionClock_desc);
    make("TerrainTile", swallowtail_TerrainTile_desc);
    make("Obstacle", swallowtail_Obstacle_desc);
    make("CoverageTask", swallowtail_CoverageTask_desc);
    make("CoveragePlan", swallowtail_CoveragePlan_desc);
    make("ChargerPlan", swallowtail_ChargerPlan_desc);
    make("PathPlan", swallowtail_PathPlan_desc);
    make("ChargerState", swallowtail_ChargerState_desc);
    make("ParticipantStatus", swallowtail_ParticipantStatus_desc);
    make("BatteryState", swallowtail_BatteryState_desc);
    make("Goal", swallowtail_Goal_desc);
    for (int tries = 0; tries < 1000; ++tries) {
      bool all = true;
      for (const auto& [name, writer] : writers_) {
        dds_publication_matched_status_t status{};
        dds_get_publication_matched_status(writer, &status);
        all = all && status.current_count > 0;
      }
      if (all) return {};
      dds_sleepfor(DDS_MSECS(10));
    }
    return internal_error("no recorder has been found within 10 s");
  }

  void send(const data::VehicleState& v) { put<swallowtail_VehicleState>("VehicleState", v); }
  void send(const data::BatteryState& v) { put<swallowtail_BatteryState>("BatteryState", v); }
  void send(const data::MissionClock& v) { put<swallowtail_MissionClock>("MissionClock", v); }
  void send(const data::TerrainTile& v) { put<swallowtail_TerrainTile>("TerrainTile", v); }
  void send(const data::Obstacle& v) { put<swallowtail_Obstacle>("Obstacle", v); }
  void send(const data::CoverageTask& v) { put<swallowtail_CoverageTask>("CoverageTask", v); }
  void send(const data::CoveragePlan& v) { put<swallowtail_CoveragePlan>("CoveragePlan", v); }
  void send(const data::ChargerPlan& v) { put<swallowtail_ChargerPlan>("ChargerPlan", v); }
  void send(const data::PathPlan& v) { put<swallowtail_PathPlan>("PathPlan", v); }
  void send(const data::ChargerState& v) { put<swallowtail_ChargerState>("ChargerState", v); }
  void send(const data::ParticipantStatus& v) { put<swallowtail_ParticipantStatus>("ParticipantStatus", v); }
  void send(const data::Goal& v) { put<swallowtail_Goal>("Goal", v); }

  void dispose(const data::Obstacle& last) {
    codec::cyclone::Sample<swallowtail_Obstacle> wire;
    codec::cyclone::to_wire(last, *wire);
    dds_writedispose(writers_.at("Obstacle"), wire.get());
  }

  Status sync() {
    for (const auto& [name, writer] : writers_) {
      if (record::find_topic(name)->reliability != Reliability::kReliable) continue;
      if (dds_wait_for_acks(writer, DDS_SECS(20)) != DDS_RETCODE_OK) {
        return internal_error("samples of " + name + " have not been acknowledged");
      }
    }
    return {};
  }

 private:
  void make(const std::string& name, const dds_topic_descriptor_t& descriptor) {
    const TopicQos& profile = *record::find_topic(name);
    dds_qos_t* qos = dds_create_qos();
    const bool is_reliable = profile.reliability == Reliability::kReliable;
    dds_qset_reliability(qos, is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                         DDS_SECS(10));
    dds_qset_durability(qos, profile.durability == Durability::kTransientLocal
                                 ? DDS_DURABILITY_TRANSIENT_LOCAL
                                 : DDS_DURABILITY_VOLATILE);
    dds_qset_ownership(
        qos, profile.ownership == Ownership::kExclusive ? DDS_OWNERSHIP_EXCLUSIVE : DDS_OWNERSHIP_SHARED);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
    dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED);
    const dds_entity_t topic = dds_create_topic(participant_, &descriptor, name.c_str(), nullptr, nullptr);
    writers_[name] = dds_create_writer(participant_, topic, qos, nullptr);
    dds_delete_qos(qos);
  }

  template <class Wire, class Data>
  void put(const char* name, const Data& value) {
    codec::cyclone::Sample<Wire> wire;
    codec::cyclone::to_wire(value, *wire);
    if (dds_write(writers_.at(name), wire.get()) != DDS_RETCODE_OK)
      std::cerr << "publish_cyclone: a sample of " << name << " was refused\n";
  }

  dds_entity_t participant_;
  std::map<std::string, dds_entity_t> writers_;
};

}  // namespace
}  // namespace swallowtail::record_test

int main(int argc, char** argv) {
  using namespace swallowtail::record_test;
  if (argc < 3) return 2;
  Sizes sizes;
  if (argc > 3) sizes.states = static_cast<std::uint32_t>(std::strtoul(argv[3], nullptr, 10));
  if (argc > 4) sizes.tiles = static_cast<std::uint32_t>(std::strtoul(argv[4], nullptr, 10));
  CycloneOut out(static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)));
  const auto done =
      publish_scenario(out, static_cast<std::uint32_t>(std::strtoul(argv[2], nullptr, 10)), sizes);
  if (!done) std::cerr << "publish_cyclone: " << done.error().message << '\n';
  return done ? 0 : 1;
}
