#include "planner/swarm/nmopso.hpp"

#include <algorithm>
#include <cmath>

#include "planner/swarm/placement.hpp"

namespace swallowtail::swarm {
namespace {

constexpr double kMemory = 0.95;   // of what moves have yielded, for each iteration
constexpr double kOctaves = 8.0;   // of mutation sizes, down from the box
constexpr double kMutated = 0.15;  // chance of a variable to be mutated; one always is

}  // namespace

Parameters parameters(NmopsoParams& p) {
  return {{"population", &p.population, 4, 100000, "ours"},
          {"inertia", &p.inertia, 0, 1, "[CLERC-KENNEDY]"},
          {"cognitive", &p.cognitive, 0, 4, "[CLERC-KENNEDY]"},
          {"social", &p.social, 0, 4, "[CLERC-KENNEDY]"},
          {"takes_part", &p.takes_part, 0, 1, "ours"},
          {"least_share", &p.least_share, 0, 0.3, "ours"},
          {"archive_capacity", &p.archive.capacity, 1, 10000, "[NMOPSO], code"},
          {"archive_divisions", &p.archive.divisions, 2, 64, "[NMOPSO], code"},
          {"archive_crowding", &p.archive.crowding, 0, 100, "[NMOPSO], code"}};
}

Status validate(const NmopsoParams& params) {
  NmopsoParams copy = params;
  return check(parameters(copy));
}

void Nmopso::init(const MultiProblem& problem, const Eigen::MatrixXd& guesses, MultiEvaluator& evaluate,
                  Rng& rng) {
  const Eigen::Index n = params_.population;
  problem_.lower = problem.lower;
  problem_.upper = problem.upper;
  problem_.vary = problem.vary;
  particles_.resize(problem.dimension(), n);
  velocities_.setZero(problem.dimension(), n);
  objectives_.resize(problem.objectives, n);
  moves_.assign(static_cast<std::size_t>(n), kFly);
  tried_.fill(1.0);
  taken_.fill(1.0);
  share_.fill(1.0 / kMoves);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i < guesses.cols()) {
      particles_.col(i) = guesses.col(i).cwiseMax(problem.lower).cwiseMin(problem.upper);
      continue;
    }
    for (Eigen::Index d = 0; d < particles_.rows(); ++d) {
      particles_(d, i) = rng.uniform(problem.lower[d], problem.upper[d]);
    }
  }
  evaluate(particles_, objectives_);
  bests_ = particles_;
  best_objectives_ = objectives_;
}

Nmopso::Move Nmopso::draw_move(Rng& rng) const {
  const double u = rng.uniform();
  if (u < share_[kFly]) return kFly;
  return u < share_[kFly] + share_[kJump] ? kJump : kVary;
}

Eigen::Ref<const Eigen::VectorXd> Nmopso::leader(const ParetoArchive& archive, Rng& rng) const {
  if (archive.size() > 0) return archive.decision(archive.draw_leader(rng));
  return bests_.col(static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(bests_.cols()))));
}

/// Any member, evenly; a particle's best while the archive holds too few for differences.
Eigen::Ref<const Eigen::VectorXd> Nmopso::member(const ParetoArchive& archive, Rng& rng) const {
  if (archive.size() >= 4) {
    return archive.decision(static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(archive.size()))));
  }
  return bests_.col(static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(bests_.cols()))));
}

void Nmopso::fly(Eigen::Index i, const ParetoArchive& archive, Rng& rng) {
  const auto g = leader(archive, rng);
  for (Eigen::Index d = 0; d < particles_.rows(); ++d) {
    double& x = particles_(d, i);
    double& v = velocities_(d, i);
    v = params_.inertia * v + rng.uniform() * params_.cognitive * (bests_(d, i) - x) +
        rng.uniform() * params_.social * (g[d] - x);
    x = std::clamp(x + v, problem_.lower[d], problem_.upper[d]);
  }
}

void Nmopso::jump(Eigen::Index i, const ParetoArchive& archive, Rng& rng) {
  const auto from = leader(archive, rng);
  const auto to = member(archive, rng);
  const auto a = member(archive, rng);
  const auto b = member(archive, rng);
  for (Eigen::Index d = 0; d < particles_.rows(); ++d) {
    double x = from[d];
    if (rng.uniform() < params_.takes_part) {
      x += rng.uniform() * (to[d] - x) + rng.uniform(-1.0, 1.0) * (a[d] - b[d]);
    }
    velocities_(d, i) = x - particles_(d, i);
    particles_(d, i) = std::clamp(x, problem_.lower[d], problem_.upper[d]);
  }
}

void Nmopso::vary(Eigen::Index i, const ParetoArchive& archive, Rng& rng) {
  const auto from = leader(archive, rng);
  velocities_.col(i).setZero();
  auto x = particles_.col(i);
  if (problem_.vary) {
    problem_.vary(from, rng, x);
    x = x.cwiseMax(problem_.lower).cwiseMin(problem_.upper);
    return;
  }
  const auto certain = static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(x.size())));
  const double size = std::exp2(-kOctaves * rng.uniform());
  for (Eigen::Index d = 0; d < x.size(); ++d) {
    x[d] = from[d];
    if (d != certain && !(rng.uniform() < kMutated)) continue;
    const double extent = problem_.upper[d] - problem_.lower[d];
    x[d] = std::clamp(x[d] + size * rng.normal() * extent, problem_.lower[d], problem_.upper[d]);
  }
}

void Nmopso::remember(Rng& rng) {
  for (Eigen::Index i = 0; i < particles_.cols(); ++i) {
    const auto now = objectives_.col(i);
    const auto best = best_objectives_.col(i);
    const bool keep = !now.allFinite() || dominates(best, now);
    if (best.allFinite() && (keep || (!dominates(now, best) && rng.uniform() < 0.5))) continue;
    best_objectives_.col(i) = now;
    bests_.col(i) = particles_.col(i);
  }
}

void Nmopso::share_out(const MultiEvaluator& evaluate) {
  for (std::size_t move = 0; move < kMoves; ++move) {
    tried_[move] *= kMemory;
    taken_[move] *= kMemory;
  }
  for (std::size_t i = 0; i < moves_.size(); ++i) {
    tried_[moves_[i]] += 1.0;
    taken_[moves_[i]] += evaluate.was_taken(static_cast<Eigen::Index>(i)) ? 1.0 : 0.0;
  }
  double sum = 0.0;
  for (std::size_t move = 0; move < kMoves; ++move) {
    share_[move] = (taken_[move] + 1e-3) / (tried_[move] + 1e-3);
    sum += share_[move];
  }
  for (double& share : share_)
    share = params_.least_share + (1.0 - kMoves * params_.least_share) * share / sum;
}

void Nmopso::step(MultiEvaluator& evaluate, Rng& rng) {
  const ParetoArchive& archive = evaluate.archive();
  for (Eigen::Index i = 0; i < particles_.cols(); ++i) {
    const Move move = draw_move(rng);
    moves_[static_cast<std::size_t>(i)] = move;
    if (move == kFly) fly(i, archive, rng);
    if (move == kJump) jump(i, archive, rng);
    if (move == kVary) vary(i, archive, rng);
  }
  evaluate(particles_, objectives_);
  remember(rng);
  share_out(evaluate);
}

void Nmopso::reassess(MultiEvaluator& evaluate) {
  evaluate.forget_archive();
  evaluate(bests_, best_objectives_);
}

}  // namespace swallowtail::swarm
