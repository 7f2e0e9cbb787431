#include "planner/swarm/pso_seed.hpp"

#include <algorithm>

#include "planner/swarm/placement.hpp"

namespace swallowtail::swarm {

Parameters parameters(PsoSeedParams& p) {
  return {{"population", &p.population, 2, 100000, "[PSO, experiment]"},
          {"inertia", &p.inertia, 0, 1, "[PSO, experiment]"},
          {"inertia_decay", &p.inertia_decay, 0, 1, "[PSO, experiment]"},
          {"cognitive", &p.cognitive, 0, 4, "[PSO, experiment]"},
          {"social", &p.social, 0, 4, "[PSO, experiment]"},
          {"near_share", &p.near_share, 0, 1, "ours"},
          {"near_radius", &p.near_radius, 0, 1, "ours"}};
}

Status validate(const PsoSeedParams& params) {
  PsoSeedParams copy = params;
  return check(parameters(copy));
}

void PsoSeed::init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng) {
  const Eigen::Index n = params_.population;
  lower_ = problem.lower;
  upper_ = problem.upper;
  inertia_ = params_.inertia;
  particles_.resize(problem.dimension(), n);
  velocities_.setZero(problem.dimension(), n);
  costs_.resize(n);
  const Eigen::Index guessed = place_guesses(problem, guesses, particles_);
  const auto near = static_cast<Eigen::Index>(params_.near_share * static_cast<double>(n));
  for (Eigen::Index i = guessed; i < n; ++i) {
    if (i - guessed < std::max<Eigen::Index>(near, 1)) {
      place_near_line(problem, i == guessed ? 0.0 : params_.near_radius, particles_.col(i), rng);
    } else {
      place_anywhere(problem, particles_.col(i), rng);
    }
  }
  evaluate(particles_, costs_);
  bests_ = particles_;
  best_costs_ = costs_;
  best_costs_.minCoeff(&leader_);
}

void PsoSeed::step(Evaluator& evaluate, Rng& rng) {
  for (Eigen::Index i = 0; i < particles_.cols(); ++i) {
    for (Eigen::Index d = 0; d < particles_.rows(); ++d) {
      const double r1 = rng.uniform();
      const double r2 = rng.uniform();
      double& x = particles_(d, i);
      double& v = velocities_(d, i);
      v = inertia_ * v + r1 * params_.cognitive * (bests_(d, i) - x) +
          r2 * params_.social * (bests_(d, leader_) - x);
      x = std::clamp(x + v, lower_[d], upper_[d]);
    }
  }
  evaluate(particles_, costs_);
  remember();
  inertia_ *= params_.inertia_decay;
}

void PsoSeed::remember() {
  for (Eigen::Index i = 0; i < particles_.cols(); ++i) {
    if (costs_[i] < best_costs_[i]) {
      best_costs_[i] = costs_[i];
      bests_.col(i) = particles_.col(i);
    }
  }
  best_costs_.minCoeff(&leader_);
}

void PsoSeed::reassess(Evaluator& evaluate) {
  evaluate(bests_, best_costs_);
  best_costs_.minCoeff(&leader_);
}

}  // namespace swallowtail::swarm
