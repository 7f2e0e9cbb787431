#pragma once

#include <Eigen/Core>

#include "planner/base/rng.hpp"
#include "planner/swarm/problem.hpp"

/// Where the agents of a first population stand.
namespace swallowtail::swarm {

/// Unit vectors along the straight line from start to goal, to its side (level unless the line is steep) and
/// up.
struct LineFrame {
  Vec3 along;
  Vec3 side;
  Vec3 up;
};
LineFrame frame_of(const WaypointLayout& ends);

/// Anywhere in the box.
void place_anywhere(const Problem& problem, Eigen::Ref<Eigen::VectorXd> agent, Rng& rng);

/// Around a path that bows from the straight line to a random side by a random share of the box; anywhere
/// where the problem is not one of waypoints. Ours: most ways round obstacles are bows.
void place_on_bow(const Problem& problem, Eigen::Ref<Eigen::VectorXd> agent, Rng& rng);

/// Waypoint w on the straight line at (w + 1)/(k + 1), each coordinate shaken by a share of the box; anywhere
/// where the problem is not one of waypoints.
void place_near_line(const Problem& problem, double share, Eigen::Ref<Eigen::VectorXd> agent, Rng& rng);

/// The guesses, as many as there is room for, first; then three bowed paths for each one anywhere.
void place_population(const Problem& problem, const Eigen::MatrixXd& guesses, Eigen::MatrixXd& agents,
                      Rng& rng);

/// The guesses, clamped into the box, in the first columns. Returns how many.
Eigen::Index place_guesses(const Problem& problem, const Eigen::MatrixXd& guesses, Eigen::MatrixXd& agents);

}  // namespace swallowtail::swarm
