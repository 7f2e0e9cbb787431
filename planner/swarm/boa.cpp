#include "planner/swarm/boa.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "planner/base/checks.hpp"

namespace swallowtail::swarm {
namespace {

/// Share of the way from `exponent` to `exponent_end` that is gone each iteration. Ours.
constexpr double kExponentRate = 0.02;
/// Chance of a variable to take part in a move; one always does. Ours: without it the swarm collapses early
/// (five spheres, 10,000 evaluations: median gap 0.05 % without, 0.02 % with it).
constexpr double kTakesPart = 0.5;
/// Noise of a bowed first path as a share of the box. Ours.
constexpr double kBowNoise = 0.05;

}  // namespace

Status validate(const BoaParams& params) {
  if (params.population < 3 || params.population > 100000) {
    return bad_input("The population is " + std::to_string(params.population) + "; it must be 3 to 100000.");
  }
  if (!is_within(params.switch_probability, 0.0, 1.0)) {
    return bad_input("The switch probability is " + std::to_string(params.switch_probability) +
                     "; it must be 0 to 1.");
  }
  if (!is_within(params.exponent, 0.0, 1.0) || !is_within(params.exponent_end, 0.0, 1.0)) {
    return bad_input("The fragrance exponents must be 0 to 1.");
  }
  return validate(params.launcher);
}

void Boa::scatter(const Problem& problem, Eigen::Index agent, Rng& rng) {
  auto x = agents_.col(agent);
  const Eigen::Index n = problem.dimension();
  if (!problem.waypoints || agent % 4 == 3) {
    for (Eigen::Index i = 0; i < n; ++i) x[i] = rng.uniform(lower_[i], upper_[i]);
    return;
  }
  const Eigen::Index count = n / 3;
  const double angle = rng.uniform(0.0, 2.0 * std::numbers::pi);
  const double height = rng.uniform();
  for (Eigen::Index w = 0; w < count; ++w) {
    const double s = static_cast<double>(w + 1) / static_cast<double>(count + 1);
    const double bow = height * std::sqrt(std::sin(std::numbers::pi * s));
    const Vec3 half = 0.5 * (upper_.segment<3>(3 * w) - lower_.segment<3>(3 * w));
    const Vec3 sway(0.0, bow * std::cos(angle), bow * std::sin(angle));
    const Vec3 noise(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    const Vec3 straight = (1.0 - s) * problem.waypoints->start + s * problem.waypoints->goal;
    x.segment<3>(3 * w) = (straight + half.cwiseProduct(sway + kBowNoise * noise))
                              .cwiseMax(lower_.segment<3>(3 * w))
                              .cwiseMin(upper_.segment<3>(3 * w));
  }
}

void Boa::rank() {
  std::sort(order_.begin(), order_.end(), [this](Eigen::Index a, Eigen::Index b) {
    return costs_[a] != costs_[b] ? costs_[a] < costs_[b] : a < b;
  });
}

void Boa::init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng) {
  const Eigen::Index n = params_.population;
  lower_ = problem.lower;
  upper_ = problem.upper;
  agents_.resize(problem.dimension(), n);
  trials_.resize(problem.dimension(), n);
  costs_.resize(n);
  trial_costs_.resize(n);
  order_.resize(static_cast<std::size_t>(n));
  std::iota(order_.begin(), order_.end(), Eigen::Index{0});
  exponent_ = params_.exponent;
  stalled_ = 0;
  launcher_.init(problem);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i < guesses.cols()) {
      agents_.col(i) = guesses.col(i).cwiseMax(lower_).cwiseMin(upper_);
    } else {
      scatter(problem, i, rng);
    }
  }
  evaluate(agents_, costs_);
  rank();
}

void Boa::reassess(Evaluator& evaluate) {
  evaluate(agents_, costs_);
  rank();
}

void Boa::step(Evaluator& evaluate, Rng& rng) {
  const auto n = static_cast<std::uint64_t>(agents_.cols());
  const double best_before = costs_[order_.front()];
  const Eigen::Index leader = order_.front();
  for (std::size_t r = 0; r < order_.size(); ++r) {
    const Eigen::Index i = order_[r];
    const double stimulus = static_cast<double>(n - r) / static_cast<double>(n);
    const double fragrance = std::pow(stimulus, exponent_);
    const bool global = rng.uniform() < params_.switch_probability && i != leader;
    const auto j = static_cast<Eigen::Index>(rng.below(n));
    const auto k = static_cast<Eigen::Index>(rng.below(n));
    const auto certain = static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(agents_.rows())));
    for (Eigen::Index d = 0; d < agents_.rows(); ++d) {
      const bool takes_part = d == certain || rng.uniform() < kTakesPart;
      const double u = rng.uniform();
      const double move = global ? 2.0 * u * (agents_(d, leader) - agents_(d, i))
                                 : (2.0 * u - 1.0) * (agents_(d, j) - agents_(d, k));
      trials_(d, i) =
          takes_part ? std::clamp(agents_(d, i) + move * fragrance, lower_[d], upper_[d]) : agents_(d, i);
    }
  }
  evaluate(trials_, trial_costs_);
  for (Eigen::Index i = 0; i < agents_.cols(); ++i) {
    if (trial_costs_[i] < costs_[i]) {
      costs_[i] = trial_costs_[i];
      agents_.col(i) = trials_.col(i);
    }
  }
  rank();
  stalled_ = costs_[order_.front()] < best_before ? 0 : stalled_ + 1;
  exponent_ += kExponentRate * (params_.exponent_end - exponent_);
  // The launcher works on the best butterfly and on one other, so that the others keep their spread.
  for (const Eigen::Index agent : {order_.front(), order_[rng.below(n)]}) {
    if (launcher_.usable() && launcher_.wants_to_fire(agents_.col(agent), stalled_)) {
      launcher_.fire(agents_.col(agent), costs_[agent], evaluate, rng);
    }
  }
  rank();
}

}  // namespace swallowtail::swarm
