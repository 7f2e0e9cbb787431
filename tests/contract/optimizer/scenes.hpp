#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/swarm/problem.hpp"

/// Problems that every optimiser must cope with. `Placement` moves a scene about without changing it.
namespace swallowtail::swarm::scenes {

struct Placement {
  Vec3 shift = Vec3::Zero();
  double turn_rad = 0.0;  ///< about the axis up
  double scale = 1.0;
  Vec3 apply(const Vec3& p) const { return scale * (Eigen::AngleAxisd(turn_rad, Vec3::UnitZ()) * p) + shift; }
};

inline Problem sphere(int dimension) {
  Problem problem;
  problem.lower = Eigen::VectorXd::Constant(dimension, -5.0);
  problem.upper = Eigen::VectorXd::Constant(dimension, 7.0);
  problem.evaluate = [](Candidates x, Costs costs) {
    for (Eigen::Index i = 0; i < x.cols(); ++i) costs[i] = (x.col(i).array() - 1.0).square().sum();
  };
  return problem;
}

inline Problem rastrigin(int dimension) {
  Problem problem = sphere(dimension);
  problem.evaluate = [](Candidates x, Costs costs) {
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      const auto y = x.col(i).array() - 1.0;
      costs[i] = (y.square() - 10.0 * (2.0 * std::numbers::pi * y).cos() + 10.0).sum();
    }
  };
  return problem;
}

struct Ball {
  Vec3 center;
  double radius;
};

/// Cost of a polyline among balls: length and ten times the depth of each segment in each ball.
inline double path_cost(const std::vector<Vec3>& path, const std::vector<Ball>& balls) {
  double cost = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec3 d = path[i] - path[i - 1];
    cost += d.norm();
    for (const Ball& ball : balls) {
      const double length2 = d.squaredNorm();
      const double s =
          length2 > 0.0 ? std::clamp((ball.center - path[i - 1]).dot(d) / length2, 0.0, 1.0) : 0.0;
      cost += 10.0 * std::max(0.0, ball.radius - (path[i - 1] + s * d - ball.center).norm());
    }
  }
  return cost;
}

/// Which frame the waypoints are variables of: one that goes with the scene, as the planner's encodings are
/// (x along start–goal), or the world's, where the box has to go with a scene that is not turned.
enum class Frame { kOfTheScene, kOfTheWorld };

/// Waypoints between two points with balls in the way, put anywhere by `placement`.
inline Problem corridor(int waypoints, const Placement& placement, Frame frame = Frame::kOfTheScene) {
  const std::vector<Ball> local = {{{10, 0.5, 0}, 3}, {{16, -3, 1}, 2.5}, {{6, -4, -1}, 2}};
  std::vector<Ball> balls;
  for (const Ball& ball : local)
    balls.push_back({placement.apply(ball.center), placement.scale * ball.radius});
  const double size = placement.scale;
  Problem problem;
  problem.waypoints = WaypointLayout{Vec3::Zero(), Vec3(20.0 * size, 0, 0)};
  problem.lower = (size * Vec3(-2, -10, -10)).replicate(waypoints, 1);
  problem.upper = (size * Vec3(22, 10, 10)).replicate(waypoints, 1);
  if (frame == Frame::kOfTheWorld) {
    problem.waypoints = WaypointLayout{placement.apply(Vec3::Zero()), placement.apply(Vec3(20, 0, 0))};
    problem.lower += placement.shift.replicate(waypoints, 1);
    problem.upper += placement.shift.replicate(waypoints, 1);
  }
  problem.evaluate = [balls, placement, frame](Candidates x, Costs costs) {
    const Eigen::AngleAxisd turn(placement.turn_rad, Vec3::UnitZ());
    std::vector<Vec3> path(static_cast<std::size_t>(x.rows() / 3 + 2));
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      path.front() = placement.apply(Vec3::Zero());
      path.back() = placement.apply(Vec3(20, 0, 0));
      for (std::size_t w = 1; w + 1 < path.size(); ++w) {
        const Vec3 p = x.col(i).segment<3>(3 * (static_cast<Eigen::Index>(w) - 1));
        path[w] = frame == Frame::kOfTheWorld ? p : Vec3(turn * p + placement.shift);
      }
      costs[i] = path_cost(path, balls);
    }
  };
  return problem;
}

}  // namespace swallowtail::swarm::scenes
