#pragma once

#include <span>
#include <vector>

#include "coverage/energy/flight.hpp"
#include "coverage/fleet/trace.hpp"

namespace swallowtail::coverage {

/// A drive of the ground robot from `start_s` on, piece by piece: on open ground at its speed, along a way of
/// Charger::travel at an even speed from where it comes upon the way until it leaves it. Split where the
/// ground bends under it. Empty when it is there.
std::vector<TimedPiece> drive_of(const Charger& charger, const FlightModel& model, const Vec3& from_m,
                                 std::span<const Vec3> bends_m, const Vec3& to_m, double start_s);

}  // namespace swallowtail::coverage
