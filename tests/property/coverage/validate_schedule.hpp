#pragma once

#include <string>
#include <vector>

#include "coverage/schedule/plan.hpp"

namespace swallowtail::coverage::test {

/// Judges a plan for the document's energy model (one unit per second in the air, none on the ground) from
/// nothing but its legs and rendezvous: each sub-cell once, no leg or transfer faster than the aircraft,
/// every landing with the reserve, charge not above capacity, the robot never faster than it drives. Shares
/// no code with the planner. Returns what is wrong.
std::vector<std::string> faults_of(const Plan& plan, const Task& task, double lead_s);

}  // namespace swallowtail::coverage::test
