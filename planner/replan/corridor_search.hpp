#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/stop.hpp"
#include "planner/replan/detour_problem.hpp"
#include "planner/swarm/registry.hpp"

namespace swallowtail::planner {

struct CorridorParams {
  std::string algorithm{"boa"};
  int population = 24;
  /// Of the swarm in each round, times the population; the descent comes on top. Ours.
  int iterations_per_round = 30;
  int max_rounds = 1'000'000;
  /// Rounds without a gain of 0.01 % after which a search that has an answer ends; 0: with the first answer.
  int idle_rounds = 12;
};

/// A path free of violations in the optimisers' eyes, and what it took.
struct Corridor {
  std::vector<Vec3> waypoints;
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

/// Rounds of swarm and descent: the swarm chooses a corridor, the descent finds its shortest path. Rounds
/// differ in seed and box (natural, then wider), every second one starts from the best so far. Every path
/// better than the last accepted one is offered to `accept`. Ends with `stop`, or after the rounds of
/// `params`. `guesses` are paths to start from, each of problem.waypoints() points.
Result<CorridorReport> search_corridor(const DetourProblem& problem, const CorridorParams& params,
                                       const StopCondition& stop, std::uint64_t seed,
                                       const std::vector<std::vector<Vec3>>& guesses,
                                       const AcceptCorridor& accept);

}  // namespace swallowtail::planner
