#pragma once

#include <cstddef>

#include "coverage/maintain/plan_keeper.hpp"

namespace swallowtail::coverage {

/// On a leg as planned, this share of it flown.
inline AircraftView on_leg(const LivePlan& plan, std::size_t leg, double share, double speed_mps = 8.0) {
  const Leg& at = plan.legs[leg];
  AircraftView view;
  view.time_s = at.start_s + share * (at.end_s - at.start_s);
  view.position_m = at.entry_m + share * (at.exit_m - at.entry_m);
  view.velocity_mps = speed_mps * (at.exit_m - at.entry_m).normalized();
  view.mode = AircraftMode::kFlying;
  view.leg_index = leg;
  view.legs_done = leg;
  return view;
}

/// Metres of strips from a leg on.
inline double cover_m(const LivePlan& plan, std::size_t first) {
  double out = 0.0;
  for (std::size_t i = first; i < plan.legs.size(); ++i) {
    if (plan.legs[i].kind == LegKind::kCover) out += (plan.legs[i].exit_m - plan.legs[i].entry_m).norm();
  }
  return out;
}

}  // namespace swallowtail::coverage
