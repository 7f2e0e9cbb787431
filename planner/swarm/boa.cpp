#include "planner/swarm/boa.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "planner/swarm/placement.hpp"

namespace swallowtail::swarm {
namespace {

/// Share of the way from `exponent` to `exponent_end` that is gone each iteration. Ours.
constexpr double kExponentRate = 0.02;
/// Chance of a variable to take part in a move; one always does. Ours: without it the swarm collapses early
/// (five spheres, 10,000 evaluations: median gap 0.05 % without, 0.02 % with it).
constexpr double kTakesPart = 0.5;

}  // namespace

Parameters parameters(BoaParams& p) {
  return {{"population", &p.population, 3, 100000, "ours"},
          {"switch_probability", &p.switch_probability, 0, 1, "[ARORA-SINGH]"},
          {"exponent", &p.exponent, 0, 1, "[ARORA-SINGH]"},
          {"exponent_end", &p.exponent_end, 0, 1, "[ARORA-SINGH]"},
          {"hop_share", &p.launcher.hop_share, 1e-6, std::numeric_limits<double>::max(), "ours"},
          {"stall_iterations", &p.launcher.stall_iterations, 1, std::numeric_limits<int>::max(), "ours"},
          {"throws", &p.launcher.throws, 1, 1000, "ours"}};
}

Status validate(const BoaParams& params) {
  BoaParams copy = params;
  if (Status status = check(parameters(copy)); !status) return status;
  return validate(params.launcher);
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
  place_population(problem, guesses, agents_, rng);
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
