#pragma once

#include <utility>
#include <vector>

#include "idl/data/types.hpp"

namespace swallowtail::sim {

using data::PathPhase;

/// Builds a PathPlan waypoint by waypoint.
struct PathBuilder {
  data::PathPlan plan;

  PathBuilder(std::uint32_t revision, double time_s, const data::Vec3& start) {
    plan.vehicle_id = 1;
    plan.revision = revision;
    plan.basis.coverage_revision = 1;
    plan.verdict = data::PathVerdict::kCertified;
    plan.waypoints.push_back(
        {.time_s = time_s, .position = start, .phase = PathPhase::kTransfer, .leg_index = 0});
  }
  PathBuilder& to(const data::Vec3& position, double duration_s, PathPhase phase, std::uint32_t leg = 0) {
    plan.waypoints.push_back({.time_s = plan.waypoints.back().time_s + duration_s,
                              .position = position,
                              .phase = phase,
                              .leg_index = leg});
    return *this;
  }
  PathBuilder& contingency() {
    plan.verdict = data::PathVerdict::kContingency;
    return *this;
  }
};

inline data::Leg strip(const data::Vec3& entry, const data::Vec3& exit) {
  data::Leg leg;
  leg.entry = entry;
  leg.exit = exit;
  leg.height_m = 20.0;
  leg.transfer = data::Transfer::kFF;
  return leg;
}

inline data::CoveragePlan plan_of(std::vector<data::Leg> legs, std::uint32_t revision = 1) {
  data::CoveragePlan plan;
  plan.task_id = 1;
  plan.vehicle_id = 1;
  plan.revision = revision;
  plan.complete = true;
  plan.legs = std::move(legs);
  if (!plan.legs.empty()) plan.legs.back().transfer = data::Transfer::kEnd;
  return plan;
}

/// Up to 20 m, along a strip of 100 m at y = 5, down at its end: 5 + 10 + 5 s from (0, 5).
inline data::PathPlan one_strip(std::uint32_t revision, double time_s) {
  return PathBuilder(revision, time_s, {0, 5, 0})
      .to({0, 5, 20}, 5.0, PathPhase::kTakeOff)
      .to({100, 5, 20}, 10.0, PathPhase::kCover)
      .to({100, 5, 0}, 5.0, PathPhase::kLanding)
      .plan;
}

}  // namespace swallowtail::sim
