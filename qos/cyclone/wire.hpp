#pragma once

#include "idl/codec/cyclone/mission.hpp"
#include "idl/codec/cyclone/plan.hpp"
#include "idl/codec/cyclone/status.hpp"
#include "idl/codec/cyclone/vehicle.hpp"
#include "idl/codec/cyclone/world.hpp"

namespace swallowtail::cyclone {

/// Which generated type carries a data type.
template <class T>
struct WireOf;

template <class W>
struct WireType {
  using Wire = W;
};

template <>
struct WireOf<data::TerrainTile> : WireType<swallowtail_TerrainTile> {};
template <>
struct WireOf<data::Obstacle> : WireType<swallowtail_Obstacle> {};
template <>
struct WireOf<data::VehicleState> : WireType<swallowtail_VehicleState> {};
template <>
struct WireOf<data::BatteryState> : WireType<swallowtail_BatteryState> {};
template <>
struct WireOf<data::CoverageTask> : WireType<swallowtail_CoverageTask> {};
template <>
struct WireOf<data::Goal> : WireType<swallowtail_Goal> {};
template <>
struct WireOf<data::MissionClock> : WireType<swallowtail_MissionClock> {};
template <>
struct WireOf<data::CoveragePlan> : WireType<swallowtail_CoveragePlan> {};
template <>
struct WireOf<data::ChargerPlan> : WireType<swallowtail_ChargerPlan> {};
template <>
struct WireOf<data::PathPlan> : WireType<swallowtail_PathPlan> {};
template <>
struct WireOf<data::ChargerState> : WireType<swallowtail_ChargerState> {};
template <>
struct WireOf<data::ParticipantStatus> : WireType<swallowtail_ParticipantStatus> {};

}  // namespace swallowtail::cyclone
