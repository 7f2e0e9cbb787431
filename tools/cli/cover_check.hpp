#pragma once

#include <string>
#include <vector>

#include "coverage/schedule/plan.hpp"

namespace swallowtail::cli {

/// What is wrong with a plan, as sentences; empty: nothing found. Looks at the finished plan alone and shares
/// no code with what made it: every sub-cell of a planned field is flown end to end exactly once, legs follow
/// each other in time, energy stays between reserve and capacity, the robot can drive from each rendezvous to
/// the next, and charging takes its time.
std::vector<std::string> check_cover(const coverage::Plan& plan, const coverage::Task& task);

}  // namespace swallowtail::cli
