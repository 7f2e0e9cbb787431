#include "planner/swarm/smart_launcher.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "planner/base/checks.hpp"

namespace swallowtail::swarm {
namespace {

constexpr double kShareMax = 1.0;
constexpr double kShareMin = 0x1p-10;

}  // namespace

Status validate(const LauncherParams& params) {
  if (!is_positive(params.hop_share)) {
    return bad_input("The launcher's hop_share is " + std::to_string(params.hop_share) +
                     "; it must be positive.");
  }
  if (params.stall_iterations < 1) return bad_input("The launcher's stall_iterations must be at least 1.");
  if (params.throws < 1 || params.throws > 1000) return bad_input("The launcher's throws must be 1 to 1000.");
  return {};
}

void SmartLauncher::init(const Problem& problem) {
  usable_ = problem.waypoints.has_value();
  if (!usable_) return;
  ends_ = *problem.waypoints;
  count_ = problem.dimension() / 3;
  lower_ = problem.lower;
  upper_ = problem.upper;
  trials_.resize(problem.dimension(), kTrials);
  trial_costs_.resize(kTrials);
  kept_.resize(problem.dimension());
  share_ = 0.5;
}

Vec3 SmartLauncher::waypoint(const Eigen::Ref<const Eigen::VectorXd>& agent, Eigen::Index i) const {
  if (i < 0) return ends_.start;
  if (i >= count_) return ends_.goal;
  return agent.segment<3>(3 * i);
}

double SmartLauncher::hop(const Eigen::Ref<const Eigen::VectorXd>& agent, Eigen::Index i) const {
  return (waypoint(agent, i) - waypoint(agent, i - 1)).norm();
}

Eigen::Index SmartLauncher::longest_hop(const Eigen::Ref<const Eigen::VectorXd>& agent) const {
  Eigen::Index longest = 0;
  for (Eigen::Index i = 1; i <= count_; ++i) {
    if (hop(agent, i) > hop(agent, longest)) longest = i;
  }
  return longest;
}

bool SmartLauncher::wants_to_fire(const Eigen::Ref<const Eigen::VectorXd>& agent,
                                  int stalled_iterations) const {
  if (!usable_) return false;
  if (stalled_iterations >= params_.stall_iterations) return true;
  return hop(agent, longest_hop(agent)) > params_.hop_share * (ends_.goal - ends_.start).norm();
}

Eigen::Index SmartLauncher::split_longest_hop(Eigen::Ref<Eigen::VectorXd> agent) const {
  Eigen::Index spare = 0;
  double least_use = 0.0;
  for (Eigen::Index i = 0; i < count_; ++i) {
    const double chord = (waypoint(agent, i + 1) - waypoint(agent, i - 1)).norm();
    const double use = hop(agent, i) + hop(agent, i + 1) - chord;
    if (i == 0 || use < least_use) {
      spare = i;
      least_use = use;
    }
  }
  const Eigen::Index end = longest_hop(agent);
  if (end == spare || end == spare + 1) return spare;
  const Vec3 middle = 0.5 * (waypoint(agent, end - 1) + waypoint(agent, end));
  for (; spare + 1 < end; ++spare) agent.segment<3>(3 * spare) = waypoint(agent, spare + 1);
  for (; spare > end; --spare) agent.segment<3>(3 * spare) = waypoint(agent, spare - 1);
  agent.segment<3>(3 * spare) = middle;
  return spare;
}

void SmartLauncher::throw_point(Eigen::Ref<Eigen::VectorXd> agent, double& cost, Eigen::Index midpoint,
                                Evaluator& evaluate, Rng& rng) {
  const Vec3 before = waypoint(agent, midpoint - 1);
  const Vec3 after = waypoint(agent, midpoint + 1);
  Vec3 tangent = after - before;
  if (tangent.squaredNorm() == 0.0) tangent = ends_.goal - ends_.start;
  if (tangent.squaredNorm() == 0.0) tangent = Vec3::UnitX();
  tangent.normalize();
  const Vec3 helper = std::abs(tangent.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitY();
  const Vec3 side = tangent.cross(helper).normalized();
  const Vec3 up = side.cross(tangent);
  const double roll = rng.uniform(0.0, 2.0 * std::numbers::pi);
  const Vec3 n1 = std::cos(roll) * side + std::sin(roll) * up;
  const Vec3 n2 = tangent.cross(n1);
  const double length =
      share_ * 0.5 * (hop(agent, midpoint) + hop(agent, midpoint + 1)) / std::numbers::sqrt3;

  const Vec3 here = waypoint(agent, midpoint);
  for (Eigen::Index d = 0; d < kTrials; ++d) {
    trials_.col(d) = agent;
    const Vec3 octant = ((d & 1) != 0 ? 1.0 : -1.0) * tangent + ((d & 2) != 0 ? 1.0 : -1.0) * n1 +
                        ((d & 4) != 0 ? 1.0 : -1.0) * n2;
    const Vec3 target = d < 8 ? Vec3(here + length * octant) : Vec3(0.5 * (before + after));
    trials_.col(d).segment<3>(3 * midpoint) =
        target.cwiseMax(lower_.segment<3>(3 * midpoint)).cwiseMin(upper_.segment<3>(3 * midpoint));
  }
  evaluate(trials_, trial_costs_);
  Eigen::Index best = 0;
  if (trial_costs_.minCoeff(&best) < cost) {
    cost = trial_costs_[best];
    agent = trials_.col(best);
    share_ = std::min(kShareMax, share_ * 1.5);
  } else {
    share_ *= 0.5;
    if (share_ < kShareMin) share_ = kShareMax;
  }
}

void SmartLauncher::fire(Eigen::Ref<Eigen::VectorXd> agent, double& cost, Evaluator& evaluate, Rng& rng) {
  const double range = params_.hop_share * (ends_.goal - ends_.start).norm();
  for (int i = 0; i < params_.throws; ++i) {
    auto midpoint = static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(count_)));
    if (i == 0 && count_ > 1 && hop(agent, longest_hop(agent)) > range) {
      kept_ = agent;
      const double kept_cost = cost;
      midpoint = split_longest_hop(agent);
      cost = std::numeric_limits<double>::infinity();
      throw_point(agent, cost, midpoint, evaluate, rng);
      if (cost <= kept_cost) continue;
      agent = kept_;
      cost = kept_cost;
      continue;
    }
    throw_point(agent, cost, midpoint, evaluate, rng);
  }
}

}  // namespace swallowtail::swarm
