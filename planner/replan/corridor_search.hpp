#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/stop.hpp"
#include "planner/replan/detour_problem.hpp"
#include "planner/swarm/registry.hpp"

namespace swallowtail::planner {

/// What takes part in a search. All of it does by default; leaving something out tells what it is worth.
struct CorridorParts {
  bool tree = true;         ///< sidestep.hpp
  bool butterflies = true;  ///< the named algorithm
  bool launcher = true;     ///< of the butterflies
  bool polish = true;       ///< taut_string.hpp
};
Status validate(const CorridorParts& parts);

struct CorridorParams {
  std::string algorithm{"boa"};
  int population = 24;
  swarm::Settings settings{};  ///< other parameters of the algorithm by name, over its defaults
  /// Of the swarm in each round at most, times the population; the polish comes on top. Ours.
  int iterations_per_round = 30;
  int max_rounds = 1'000'000;
  /// Rounds without a gain of 0.01 % after which a search that has an answer ends; 0: with the first answer.
  int idle_rounds = 12;
  /// Chains may grow to so many points, ends included, where the polish needs them.
  std::size_t most_points = 64;
  CorridorParts parts{};
};

/// A path free of violations in the search's eyes, and what it took.
struct Corridor {
  std::vector<Vec3> waypoints;  ///< between the ends; any number; no hop steeper than the climb limit
  DetourProblem::Cost cost;
  double value = 0.0;
};

struct CorridorReport {
  bool interrupted = false;
  std::uint64_t evaluations = 0;
  double least_violation_m = 0.0;  ///< of the best path, 0 if one was found
};

/// What the caller says to a candidate: take it (it is certified), or not (the certifier refused it).
using AcceptCorridor = std::function<bool(const Corridor&, std::uint64_t evaluations)>;

/// Anytime search in rounds. First a tree of sidesteps gives a path at once and the taut string shortens it.
/// Each round then looks for other corridors: sidesteps in random order, and a swarm (natural box, then
/// wider; every second round from the best so far) whose best is pulled taut. Paths of many points are
/// improved stretch by stretch. Every path better than the last accepted one is offered to `accept`. Ends
/// with `stop`, or after the rounds of `params`. One evaluation is one look at a whole path of
/// problem.waypoints() points, or as many hops looked at by the tree. `guesses` are paths to start from, of
/// any number of points.
Result<CorridorReport> search_corridor(const DetourProblem& problem, const CorridorParams& params,
                                       const StopCondition& stop, std::uint64_t seed,
                                       const std::vector<std::vector<Vec3>>& guesses,
                                       const AcceptCorridor& accept);

}  // namespace swallowtail::planner
