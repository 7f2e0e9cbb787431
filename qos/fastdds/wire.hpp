#pragma once

#include "idl/codec/fastdds/mission.hpp"
#include "idl/codec/fastdds/plan.hpp"
#include "idl/codec/fastdds/status.hpp"
#include "idl/codec/fastdds/vehicle.hpp"
#include "idl/codec/fastdds/world.hpp"

#define swallowtail swallowtail_wire
#include "missionPubSubTypes.h"
#include "planPubSubTypes.h"
#include "statusPubSubTypes.h"
#include "vehiclePubSubTypes.h"
#include "worldPubSubTypes.h"
#undef swallowtail

namespace swallowtail::fast {

/// Which generated types carry a data type.
template <class T>
struct WireOf;

template <class W, class Support>
struct WirePair {
  using Wire = W;
  using TypeSupport = Support;
};

template <>
struct WireOf<data::TerrainTile>
    : WirePair<swallowtail_wire::TerrainTile, swallowtail_wire::TerrainTilePubSubType> {};
template <>
struct WireOf<data::Obstacle> : WirePair<swallowtail_wire::Obstacle, swallowtail_wire::ObstaclePubSubType> {};
template <>
struct WireOf<data::VehicleState>
    : WirePair<swallowtail_wire::VehicleState, swallowtail_wire::VehicleStatePubSubType> {};
template <>
struct WireOf<data::BatteryState>
    : WirePair<swallowtail_wire::BatteryState, swallowtail_wire::BatteryStatePubSubType> {};
template <>
struct WireOf<data::CoverageTask>
    : WirePair<swallowtail_wire::CoverageTask, swallowtail_wire::CoverageTaskPubSubType> {};
template <>
struct WireOf<data::Goal> : WirePair<swallowtail_wire::Goal, swallowtail_wire::GoalPubSubType> {};
template <>
struct WireOf<data::MissionClock>
    : WirePair<swallowtail_wire::MissionClock, swallowtail_wire::MissionClockPubSubType> {};
template <>
struct WireOf<data::CoveragePlan>
    : WirePair<swallowtail_wire::CoveragePlan, swallowtail_wire::CoveragePlanPubSubType> {};
template <>
struct WireOf<data::ChargerPlan>
    : WirePair<swallowtail_wire::ChargerPlan, swallowtail_wire::ChargerPlanPubSubType> {};
template <>
struct WireOf<data::PathPlan> : WirePair<swallowtail_wire::PathPlan, swallowtail_wire::PathPlanPubSubType> {};
template <>
struct WireOf<data::ChargerState>
    : WirePair<swallowtail_wire::ChargerState, swallowtail_wire::ChargerStatePubSubType> {};
template <>
struct WireOf<data::ParticipantStatus>
    : WirePair<swallowtail_wire::ParticipantStatus, swallowtail_wire::ParticipantStatusPubSubType> {};

}  // namespace swallowtail::fast
