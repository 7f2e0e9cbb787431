#include "planner/swarm/nmopso_seed.hpp"

#include <algorithm>

namespace swallowtail::swarm {
namespace {

/// Whether `now` takes the place of `before`: it dominates, or neither does and the coin says so.
bool replaces(const Eigen::Ref<const Eigen::VectorXd>& now, const Eigen::Ref<const Eigen::VectorXd>& before,
              Rng& rng) {
  if (dominates(now, before)) return true;
  return !dominates(before, now) && rng.uniform() < 0.5;
}

}  // namespace

Parameters parameters(NmopsoSeedParams& p) {
  return {{"population", &p.population, 4, 100000, "[NMOPSO], code"},
          {"generations", &p.generations, 2, 1e6, "[NMOPSO], code"},
          {"inertia", &p.inertia, 0, 1, "[NMOPSO], code"},
          {"inertia_decay", &p.inertia_decay, 0, 1, "[NMOPSO], code"},
          {"cognitive", &p.cognitive, 0, 4, "[NMOPSO], code"},
          {"social", &p.social, 0, 4, "[NMOPSO], code"},
          {"velocity_share", &p.velocity_share, 0.001, 1, "ours"},
          {"archive_capacity", &p.archive.capacity, 1, 10000, "[NMOPSO], code"},
          {"archive_divisions", &p.archive.divisions, 2, 64, "[NMOPSO], code"},
          {"archive_crowding", &p.archive.crowding, 0, 100, "[NMOPSO], code"}};
}

Status validate(const NmopsoSeedParams& params) {
  NmopsoSeedParams copy = params;
  return check(parameters(copy));
}

void NmopsoSeed::init(const MultiProblem& problem, const Eigen::MatrixXd& guesses, MultiEvaluator& evaluate,
                      Rng& rng) {
  const Eigen::Index n = params_.population;
  lower_ = problem.lower;
  upper_ = problem.upper;
  inertia_ = params_.inertia;
  iteration_ = 0;
  particles_.resize(problem.dimension(), n);
  velocities_.setZero(problem.dimension(), n);
  objectives_.resize(problem.objectives, n);
  mutants_.resize(problem.dimension(), n);
  mutant_objectives_.resize(problem.objectives, n);
  mutated_.assign(static_cast<std::size_t>(n), 0);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index d = 0; d < particles_.rows(); ++d) {
      particles_(d, i) = i < guesses.cols() ? std::clamp(guesses(d, i), lower_[d], upper_[d])
                                            : rng.uniform(lower_[d], upper_[d]);
    }
  }
  evaluate(particles_, objectives_);
  bests_ = particles_;
  best_objectives_ = objectives_;
}

void NmopsoSeed::fly(MultiEvaluator& evaluate, Rng& rng) {
  const ParetoArchive& archive = evaluate.archive();
  for (Eigen::Index i = 0; i < particles_.cols(); ++i) {
    const Eigen::Index leader = archive.size() > 0 ? archive.draw_leader(rng) : -1;
    for (Eigen::Index d = 0; d < particles_.rows(); ++d) {
      double& x = particles_(d, i);
      double& v = velocities_(d, i);
      const double g = leader >= 0 ? archive.decisions()(d, leader) : bests_(d, i);
      v = inertia_ * v + rng.uniform() * params_.cognitive * (bests_(d, i) - x) +
          rng.uniform() * params_.social * (g - x);
      const double most = params_.velocity_share * (upper_[d] - lower_[d]);
      v = std::clamp(v, -most, most);
      x += v;
      if (x < lower_[d] || x > upper_[d]) v = -v;
      x = std::clamp(x, lower_[d], upper_[d]);
    }
  }
  evaluate(particles_, objectives_);
}

void NmopsoSeed::mutate(double probability, MultiEvaluator& evaluate, Rng& rng) {
  Eigen::Index n = 0;
  for (Eigen::Index i = 0; i < particles_.cols(); ++i) {
    if (!(rng.uniform() < probability)) continue;
    const auto d = static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(particles_.rows())));
    const double reach = probability * (upper_[d] - lower_[d]);
    mutants_.col(n) = particles_.col(i);
    mutants_(d, n) = rng.uniform(std::max(lower_[d], particles_(d, i) - reach),
                                 std::min(upper_[d], particles_(d, i) + reach));
    mutated_[static_cast<std::size_t>(n++)] = i;
  }
  if (n == 0) return;
  evaluate(mutants_.leftCols(n), mutant_objectives_.leftCols(n));
  for (Eigen::Index m = 0; m < n; ++m) {
    const Eigen::Index i = mutated_[static_cast<std::size_t>(m)];
    if (!replaces(mutant_objectives_.col(m), objectives_.col(i), rng)) continue;
    particles_.col(i) = mutants_.col(m);
    objectives_.col(i) = mutant_objectives_.col(m);
  }
}

void NmopsoSeed::step(MultiEvaluator& evaluate, Rng& rng) {
  fly(evaluate, rng);
  const double gone = std::min(1.0, static_cast<double>(iteration_) / (params_.generations - 1));
  mutate((1.0 - gone) * (1.0 - gone), evaluate, rng);
  for (Eigen::Index i = 0; i < particles_.cols(); ++i) {
    if (!replaces(objectives_.col(i), best_objectives_.col(i), rng)) continue;
    best_objectives_.col(i) = objectives_.col(i);
    bests_.col(i) = particles_.col(i);
  }
  inertia_ *= params_.inertia_decay;
  ++iteration_;
}

void NmopsoSeed::reassess(MultiEvaluator& evaluate) {
  evaluate.forget_archive();
  evaluate(bests_, best_objectives_);
}

}  // namespace swallowtail::swarm
