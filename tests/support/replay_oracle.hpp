#pragma once

#include <string>
#include <vector>

#include "coverage/schedule/plan.hpp"
#include "tests/support/replay_robot.hpp"

/// Flies and drives a coverage plan from nothing but the task and the plan, in small steps, and holds what
/// happens against what the plan says. Shares no code with coverage/.
namespace swallowtail::test_support {

struct ReplayQuestion {
  GroundAt ground_m;
  ReplayRoads robot;
  double take_off_s = 0.0;   ///< the aircraft waits at its start so long
  double lead_s = 1.0;       ///< from ready until the aircraft leaves the ground
  Watch watch{};             ///< of the whole flight
  DriveWatch watch_robot{};  ///< it leaves in time to arrive when the plan says
  double energy_margin =
      0.0;                    ///< share of a flight's energy that must be left besides the reserve on landing
  double energy_spare = 0.0;  ///< besides
  double step_s = 0.02;
  double time_tolerance_s = 1e-4;    ///< claim against replay, per flight
  double energy_tolerance = 1e-4;    ///< the same
  double raster_m = 1.0;             ///< of the cover's check; 0: not asked
  double covered_share = 0.999;      ///< of each planned field, at the right height
  double height_tolerance_m = 1e-6;  ///< of legs, besides the task's own
};

struct ReplayVerdict {
  std::vector<std::string> faults;  ///< empty: the plan holds
  double end_s = 0.0;
  double least_energy = 0.0;   ///< at any instant
  double covered_share = 1.0;  ///< of the worst field
};

/// The aircraft takes off at the start at take_off_s with a full battery and does what legs and rendezvous
/// say. Faults:
/// - energy below the reserve at any instant, or less left on landing than margin and spare ask for;
/// - a claimed time or energy of a leg or rendezvous that the replay does not find;
/// - a rendezvous that is not below its leg's end, too short for handling, charging and carrying, or charging
///   beyond capacity; one that no transfer asks for, or none where one does;
/// - a robot that would have to be faster than it is, or whose own battery does not last to its depot;
/// - a sub-cell not flown exactly once from end to end; a field not covered at its height; a line outside its
///   field; a flight over a hole or no-fly area that it did not begin or end in;
/// - totals (cost, makespan, lengths, times, energies, waiting, recharges) that are not the sums of the
/// parts.
ReplayVerdict replay(const coverage::Task& task, const coverage::Plan& plan, const ReplayQuestion& question);

}  // namespace swallowtail::test_support
