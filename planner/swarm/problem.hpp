#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"

namespace swallowtail::swarm {

/// (dimension × n), one candidate a column; and one cost for each.
using Candidates = Eigen::Ref<const Eigen::MatrixXd>;
using Costs = Eigen::Ref<Eigen::VectorXd>;

/// Says that a candidate is a path in space: its 3k variables are the k waypoints (x, y, z) between two fixed
/// ends, all in one isometric frame and unit. What moves single waypoints (the smart launcher) needs it.
struct WaypointLayout {
  Vec3 start = Vec3::Zero();
  Vec3 goal = Vec3::Zero();
};

/// What an optimiser minimises: a box and a function. Nothing here knows what the variables mean.
struct Problem {
  Eigen::VectorXd lower;  ///< (dimension)
  Eigen::VectorXd upper;  ///< (dimension)
  /// Writes the cost of each column. An infeasible candidate is a value (graded, or +infinity), never an
  /// exception; NaN counts as +infinity.
  std::function<void(Candidates, Costs)> evaluate;
  std::optional<WaypointLayout> waypoints;
  /// For costs that depend on the iteration (Step of [BOA Eq. 16]); may be empty. The driver calls it with 0
  /// before the first population and with 1, 2, … before each step. True: costs are others than before, and
  /// what is remembered (the best so far, the swarm) is evaluated anew, which counts.
  std::function<bool(std::uint64_t iteration)> begin_iteration;

  Eigen::Index dimension() const { return lower.size(); }
};

/// Refuses: no dimension, sizes that differ, bounds that are not finite, an empty box, no function, a layout
/// that does not fit the dimension.
Status validate(const Problem& problem);

}  // namespace swallowtail::swarm
