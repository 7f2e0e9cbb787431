#include "planner/swarm/pso.hpp"

#include <algorithm>

#include "planner/swarm/placement.hpp"

namespace swallowtail::swarm {

Parameters parameters(PsoParams& p) {
  return {{"population", &p.population, 4, 100000, "ours"},
          {"inertia", &p.inertia, 0, 1, "[CLERC-KENNEDY]"},
          {"cognitive", &p.cognitive, 0, 4, "[CLERC-KENNEDY]"},
          {"social", &p.social, 0, 4, "[CLERC-KENNEDY]"},
          {"informants", &p.informants, 1, 1000, "ours"},
          {"takes_part", &p.takes_part, 0, 1, "ours"},
          {"jump", &p.jump, 0, 1, "ours"}};
}

Status validate(const PsoParams& params) {
  PsoParams copy = params;
  return check(parameters(copy));
}

void Pso::init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng) {
  const Eigen::Index n = params_.population;
  lower_ = problem.lower;
  upper_ = problem.upper;
  particles_.resize(problem.dimension(), n);
  velocities_.setZero(problem.dimension(), n);
  costs_.resize(n);
  place_population(problem, guesses, particles_, rng);
  evaluate(particles_, costs_);
  bests_ = particles_;
  best_costs_ = costs_;
}

Eigen::Index Pso::best_informant(Eigen::Index particle, Rng& rng) const {
  Eigen::Index best = particle;
  for (int i = 0; i < params_.informants; ++i) {
    const auto other = static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(bests_.cols())));
    if (best_costs_[other] < best_costs_[best]) best = other;
  }
  return best;
}

void Pso::fly(Eigen::Index i, Eigen::Index l, Rng& rng) {
  const auto certain = static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(bests_.rows())));
  for (Eigen::Index d = 0; d < bests_.rows(); ++d) {
    double& x = particles_(d, i);
    if (d != certain && !(rng.uniform() < params_.takes_part)) {
      x = bests_(d, i);
      continue;
    }
    double& v = velocities_(d, i);
    v = params_.inertia * v + rng.uniform() * params_.cognitive * (bests_(d, i) - x) +
        rng.uniform() * params_.social * (bests_(d, l) - x);
    x = std::clamp(x + v, lower_[d], upper_[d]);
  }
}

void Pso::jump(Eigen::Index i, Eigen::Index l, Rng& rng) {
  const auto n = static_cast<std::uint64_t>(bests_.cols());
  const auto a = static_cast<Eigen::Index>(rng.below(n));
  const auto b = static_cast<Eigen::Index>(rng.below(n));
  const auto certain = static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(bests_.rows())));
  for (Eigen::Index d = 0; d < bests_.rows(); ++d) {
    double to = bests_(d, i);
    if (d == certain || rng.uniform() < params_.takes_part) {
      const double u = rng.uniform();
      const double w = rng.uniform(-1.0, 1.0);
      to += u * (bests_(d, l) - bests_(d, i)) + w * (bests_(d, a) - bests_(d, b));
    }
    velocities_(d, i) = to - particles_(d, i);
    particles_(d, i) = std::clamp(to, lower_[d], upper_[d]);
  }
}

void Pso::step(Evaluator& evaluate, Rng& rng) {
  for (Eigen::Index i = 0; i < particles_.cols(); ++i) {
    const Eigen::Index informant = best_informant(i, rng);
    if (rng.uniform() < params_.jump) {
      jump(i, informant, rng);
    } else {
      fly(i, informant, rng);
    }
  }
  evaluate(particles_, costs_);
  for (Eigen::Index i = 0; i < particles_.cols(); ++i) {
    if (costs_[i] < best_costs_[i]) {
      best_costs_[i] = costs_[i];
      bests_.col(i) = particles_.col(i);
    }
  }
}

void Pso::reassess(Evaluator& evaluate) { evaluate(bests_, best_costs_); }

}  // namespace swallowtail::swarm
