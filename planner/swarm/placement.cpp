#include "planner/swarm/placement.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace swallowtail::swarm {
namespace {

/// Noise of a bowed path as a share of the box.
constexpr double kBowNoise = 0.05;

}  // namespace

LineFrame frame_of(const WaypointLayout& ends) {
  Vec3 along = ends.goal - ends.start;
  if (along.squaredNorm() == 0.0) along = Vec3::UnitX();
  along.normalize();
  const Vec3 helper = std::abs(along.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitY();
  const Vec3 side = helper.cross(along).normalized();
  return {along, side, along.cross(side)};
}

void place_anywhere(const Problem& problem, Eigen::Ref<Eigen::VectorXd> agent, Rng& rng) {
  for (Eigen::Index i = 0; i < agent.size(); ++i) {
    agent[i] = rng.uniform(problem.lower[i], problem.upper[i]);
  }
}

void place_on_bow(const Problem& problem, Eigen::Ref<Eigen::VectorXd> agent, Rng& rng) {
  if (!problem.waypoints) return place_anywhere(problem, agent, rng);
  const Eigen::Index count = agent.size() / 3;
  const auto [along, side, up] = frame_of(*problem.waypoints);
  const double angle = rng.uniform(0.0, 2.0 * std::numbers::pi);
  const double height = rng.uniform();
  for (Eigen::Index w = 0; w < count; ++w) {
    const double s = static_cast<double>(w + 1) / static_cast<double>(count + 1);
    const double bow = height * std::sqrt(std::sin(std::numbers::pi * s));
    const Vec3 lower = problem.lower.segment<3>(3 * w);
    const Vec3 upper = problem.upper.segment<3>(3 * w);
    const Vec3 half = 0.5 * (upper - lower);
    const Vec3 sway = bow * std::cos(angle) * half.dot(side.cwiseAbs()) * side +
                      bow * std::sin(angle) * half.dot(up.cwiseAbs()) * up;
    const Vec3 noise(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    const Vec3 straight = (1.0 - s) * problem.waypoints->start + s * problem.waypoints->goal;
    agent.segment<3>(3 * w) =
        (straight + sway + kBowNoise * half.cwiseProduct(noise)).cwiseMax(lower).cwiseMin(upper);
  }
}

void place_near_line(const Problem& problem, double share, Eigen::Ref<Eigen::VectorXd> agent, Rng& rng) {
  if (!problem.waypoints) return place_anywhere(problem, agent, rng);
  const Eigen::Index count = agent.size() / 3;
  for (Eigen::Index w = 0; w < count; ++w) {
    const double s = static_cast<double>(w + 1) / static_cast<double>(count + 1);
    const Vec3 straight = (1.0 - s) * problem.waypoints->start + s * problem.waypoints->goal;
    for (Eigen::Index d = 0; d < 3; ++d) {
      const Eigen::Index i = 3 * w + d;
      const double extent = problem.upper[i] - problem.lower[i];
      agent[i] = std::clamp(straight[d] + share * rng.uniform(-1.0, 1.0) * extent, problem.lower[i],
                            problem.upper[i]);
    }
  }
}

Eigen::Index place_guesses(const Problem& problem, const Eigen::MatrixXd& guesses, Eigen::MatrixXd& agents) {
  const Eigen::Index n = std::min(guesses.cols(), agents.cols());
  for (Eigen::Index i = 0; i < n; ++i) {
    agents.col(i) = guesses.col(i).cwiseMax(problem.lower).cwiseMin(problem.upper);
  }
  return n;
}

void place_population(const Problem& problem, const Eigen::MatrixXd& guesses, Eigen::MatrixXd& agents,
                      Rng& rng) {
  for (Eigen::Index i = place_guesses(problem, guesses, agents); i < agents.cols(); ++i) {
    if (i % 4 == 3) {
      place_anywhere(problem, agents.col(i), rng);
    } else {
      place_on_bow(problem, agents.col(i), rng);
    }
  }
}

}  // namespace swallowtail::swarm
