#pragma once

#include <vector>

#include "coverage/fleet/fleet.hpp"

namespace swallowtail::coverage {

/// The robot drives back to where it started when its last rendezvous is over, if it can and has had any.
void send_home(Member& member, const FlightModel& model);

/// Delays members until they keep their distance, the longest first; one that finds no time, or ends latest,
/// is heard before all others, a few times. Errors (kInfeasible): no delays do, and they stay as they are.
Status separate(std::vector<Member>& members, const Separation& separation, const FlightModel& model);

/// Whether members keep their distance as they are.
bool are_apart(const std::vector<Member>& members, const Separation& separation, const FlightModel& model);

}  // namespace swallowtail::coverage
