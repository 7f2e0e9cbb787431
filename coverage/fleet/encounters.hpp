#pragma once

#include <span>
#include <vector>

#include "coverage/fleet/fleet.hpp"

namespace swallowtail::coverage {

/// Of each pair of robots the moment when they are nearest while at least one of them drives, if they are
/// then nearer than apart_m. A robot drives to its next rendezvous as soon as it is free, at an even speed on
/// each of its drives, and stays where its last one ends.
std::vector<Encounter> encounters_of(std::span<const Member> members, double apart_m);

}  // namespace swallowtail::coverage
