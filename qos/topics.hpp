#pragma once

#include <array>
#include <cstdint>

#include "idl/data/types.hpp"
#include "qos/bus.hpp"

/// The one table of topics: names, keys and QoS, free of any vendor. The buses apply it to every endpoint
/// they make; the vendors' XML profiles repeat it for other programs, and a test compares both with what
/// endpoints announce on the wire. Times are wall time.
namespace swallowtail {

enum class Reliability : std::uint8_t { kBestEffort, kReliable };
enum class Durability : std::uint8_t { kVolatile, kTransientLocal };
enum class Ownership : std::uint8_t { kShared, kExclusive };

struct TopicQos {
  const char* name;       ///< of the topic: the type's without its module
  const char* type_name;  ///< on the wire
  int key_fields;         ///< unsigned long each; 0: no key
  Reliability reliability;
  Durability durability;
  Ownership ownership;
  int deadline_offered_ms;    ///< 0: none. An alarm only: failover never rests on it
  int deadline_requested_ms;  ///< 0: none
  int lifespan_ms;            ///< 0: none; the same at both ends, as Fast DDS readers go by their own
  int lease_ms;               ///< manual-by-topic liveliness, offered and requested; 0: none
  int max_instances;
  int history_depth = 1;
  constexpr int max_samples() const { return max_instances * history_depth; }
};

inline constexpr int kPlanLease_ms = 300;

/// Obstacles have no lifespan: a standing one is published once and must still reach whoever starts an hour
/// later; a track ends by its `valid_until_s`, which is mission time. A PathPlan's writer publishes at least
/// every 10 s. The reader's deadline may hand ownership to a weaker writer (a Fast DDS reader does so), hence
/// far above the lease.
inline constexpr std::array<TopicQos, 12> kTopics = {{
    // clang-format off
    // name              type                             key reliability              durability                    ownership              offered requested lifespan  lease          instances
    {"TerrainTile",       "swallowtail::TerrainTile",       3, Reliability::kReliable,   Durability::kTransientLocal, Ownership::kShared,         0,      0,      0,  0,              512},
    {"Obstacle",          "swallowtail::Obstacle",          1, Reliability::kReliable,   Durability::kTransientLocal, Ownership::kShared,         0,      0,      0,  0,              10000},
    {"VehicleState",      "swallowtail::VehicleState",      1, Reliability::kBestEffort, Durability::kVolatile,       Ownership::kShared,      1000,   2000,      0,  0,              64},
    {"BatteryState",      "swallowtail::BatteryState",      1, Reliability::kReliable,   Durability::kTransientLocal, Ownership::kShared,      2000,   4000,  10000,  0,              64},
    {"CoverageTask",      "swallowtail::CoverageTask",      1, Reliability::kReliable,   Durability::kTransientLocal, Ownership::kShared,         0,      0,      0,  0,              16},
    {"Goal",              "swallowtail::Goal",              1, Reliability::kReliable,   Durability::kTransientLocal, Ownership::kShared,         0,      0,      0,  0,              64},
    {"MissionClock",      "swallowtail::MissionClock",      0, Reliability::kBestEffort, Durability::kVolatile,       Ownership::kShared,         0,      0,      0,  0,              1},
    {"CoveragePlan",      "swallowtail::CoveragePlan",      2, Reliability::kReliable,   Durability::kTransientLocal, Ownership::kExclusive,      0,      0,      0,  kPlanLease_ms,  64},
    {"ChargerPlan",       "swallowtail::ChargerPlan",       1, Reliability::kReliable,   Durability::kTransientLocal, Ownership::kExclusive,      0,      0,      0,  kPlanLease_ms,  64},
    {"PathPlan",          "swallowtail::PathPlan",          1, Reliability::kReliable,   Durability::kTransientLocal, Ownership::kExclusive,  10000,  20000,      0,  kPlanLease_ms,  64},
    {"ChargerState",      "swallowtail::ChargerState",      1, Reliability::kReliable,   Durability::kVolatile,       Ownership::kShared,      2000,   4000,      0,  0,              64},
    {"ParticipantStatus", "swallowtail::ParticipantStatus", 1, Reliability::kReliable,   Durability::kTransientLocal, Ownership::kShared,      5000,  10000,      0,  0,              64},
    // clang-format on
}};

/// The row of a type and the key of a sample of it.
template <class T>
struct TopicOf;

template <std::size_t Row>
struct TopicRow {
  static constexpr const TopicQos& qos = kTopics[Row];
};

template <>
struct TopicOf<data::TerrainTile> : TopicRow<0> {
  static InstanceKey key(const data::TerrainTile& v) { return {v.map_id, v.row, v.col}; }
};
template <>
struct TopicOf<data::Obstacle> : TopicRow<1> {
  static InstanceKey key(const data::Obstacle& v) { return {v.obstacle_id, 0, 0}; }
};
template <>
struct TopicOf<data::VehicleState> : TopicRow<2> {
  static InstanceKey key(const data::VehicleState& v) { return {v.vehicle_id, 0, 0}; }
};
template <>
struct TopicOf<data::BatteryState> : TopicRow<3> {
  static InstanceKey key(const data::BatteryState& v) { return {v.vehicle_id, 0, 0}; }
};
template <>
struct TopicOf<data::CoverageTask> : TopicRow<4> {
  static InstanceKey key(const data::CoverageTask& v) { return {v.task_id, 0, 0}; }
};
template <>
struct TopicOf<data::Goal> : TopicRow<5> {
  static InstanceKey key(const data::Goal& v) { return {v.vehicle_id, 0, 0}; }
};
template <>
struct TopicOf<data::MissionClock> : TopicRow<6> {
  static InstanceKey key(const data::MissionClock&) { return {}; }
};
template <>
struct TopicOf<data::CoveragePlan> : TopicRow<7> {
  static InstanceKey key(const data::CoveragePlan& v) { return {v.task_id, v.vehicle_id, 0}; }
};
template <>
struct TopicOf<data::ChargerPlan> : TopicRow<8> {
  static InstanceKey key(const data::ChargerPlan& v) { return {v.charger_id, 0, 0}; }
};
template <>
struct TopicOf<data::PathPlan> : TopicRow<9> {
  static InstanceKey key(const data::PathPlan& v) { return {v.vehicle_id, 0, 0}; }
};
template <>
struct TopicOf<data::ChargerState> : TopicRow<10> {
  static InstanceKey key(const data::ChargerState& v) { return {v.charger_id, 0, 0}; }
};
template <>
struct TopicOf<data::ParticipantStatus> : TopicRow<11> {
  static InstanceKey key(const data::ParticipantStatus& v) { return {v.participant_id, 0, 0}; }
};

}  // namespace swallowtail
