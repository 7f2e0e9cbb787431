#include "planner/swarm/ibabc_seed.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "planner/swarm/placement.hpp"

namespace swallowtail::swarm {

Parameters parameters(IbabcSeedParams& p) {
  return {{"population", &p.population, 3, 100000, "ours"},
          {"trial_limit", &p.trial_limit, 1, 1e6, "ours"},
          {"scouting", &p.scouting, 0.001, 1, "[IBABC Eq. 10]"}};
}

Status validate(const IbabcSeedParams& params) {
  IbabcSeedParams copy = params;
  return check(parameters(copy));
}

/// [IBABC Eq. 1]
void IbabcSeed::place(Eigen::Ref<Eigen::VectorXd> source, Rng& rng) const {
  place_anywhere(problem_, source, rng);
  if (!problem_.waypoints) return;
  const Vec3 start = problem_.waypoints->start;
  const Vec3 line = problem_.waypoints->goal - start;
  const double squared = line.squaredNorm();
  if (squared == 0.0) return;
  for (Eigen::Index j = 0; j < elements_; ++j) {
    const double s = static_cast<double>(j + 1) / static_cast<double>(elements_ + 1);
    Vec3 p = source.segment<3>(3 * j);
    p += (s - (p - start).dot(line) / squared) * line;
    source.segment<3>(3 * j) =
        p.cwiseMax(problem_.lower.segment<3>(3 * j)).cwiseMin(problem_.upper.segment<3>(3 * j));
  }
}

void IbabcSeed::init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng) {
  const Eigen::Index n = params_.population;
  problem_.lower = problem.lower;
  problem_.upper = problem.upper;
  problem_.waypoints = problem.waypoints;
  element_size_ = problem.waypoints ? 3 : 1;
  elements_ = problem.dimension() / element_size_;
  sources_.resize(problem.dimension(), n);
  trials_.resize(problem.dimension(), n);
  costs_.resize(n);
  trial_costs_.resize(n);
  tries_.setOnes(n);
  drawn_.resize(static_cast<std::size_t>(n));
  std::iota(drawn_.begin(), drawn_.end(), Eigen::Index{0});
  for (Eigen::Index i = place_guesses(problem, guesses, sources_); i < n; ++i) place(sources_.col(i), rng);
  evaluate(sources_, costs_);
}

/// [IBABC Eq. 7, 9]
void IbabcSeed::move_element(Eigen::Index source, Eigen::Index element, double scale, Rng& rng) {
  auto k = static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(sources_.cols() - 1)));
  if (k >= source) ++k;
  const double phi = rng.uniform(-1.0, 1.0) * scale;
  const Eigen::Index first = element * element_size_;
  const auto x = sources_.col(source).segment(first, element_size_);
  trials_.col(source).segment(first, element_size_) =
      (x + phi * (x - sources_.col(k).segment(first, element_size_)))
          .cwiseMax(problem_.lower.segment(first, element_size_))
          .cwiseMin(problem_.upper.segment(first, element_size_));
}

void IbabcSeed::evaluate_and_choose(Evaluator& evaluate) {
  evaluate(trials_, trial_costs_);
  for (Eigen::Index i = 0; i < sources_.cols(); ++i) {
    if (trial_costs_[i] < costs_[i]) {
      costs_[i] = trial_costs_[i];
      sources_.col(i) = trials_.col(i);
      tries_[i] = 1.0;
    } else {
      tries_[i] += 1.0;
    }
  }
}

void IbabcSeed::step(Evaluator& evaluate, Rng& rng) {
  const auto elements = static_cast<std::uint64_t>(elements_);
  trials_ = sources_;
  for (Eigen::Index i = 0; i < sources_.cols(); ++i) {
    move_element(i, static_cast<Eigen::Index>(rng.below(elements)), 1.0 / tries_[i], rng);
  }
  evaluate_and_choose(evaluate);
  trials_ = sources_;
  for (Eigen::Index i = 0; i < sources_.cols(); ++i) {
    const auto first = static_cast<Eigen::Index>(rng.below(elements));
    move_element(i, first, 1.0, rng);
    if (elements_ < 2) continue;
    auto second = static_cast<Eigen::Index>(rng.below(elements - 1));
    if (second >= first) ++second;
    move_element(i, second, 1.0, rng);
  }
  evaluate_and_choose(evaluate);
  for (double& tr : tries_) {
    if (tr > params_.trial_limit) tr = 1.0;
  }
  if (tries_.mean() > params_.scouting * static_cast<double>(elements_)) send_scouts(evaluate, rng);
}

/// γ SN sources drawn without repetition go and come back anywhere.
void IbabcSeed::send_scouts(Evaluator& evaluate, Rng& rng) {
  const Eigen::Index n = sources_.cols();
  const auto scouts =
      std::max<Eigen::Index>(1, static_cast<Eigen::Index>(params_.scouting * static_cast<double>(n)));
  for (Eigen::Index s = 0; s < scouts; ++s) {
    const auto other = static_cast<std::size_t>(s) + rng.below(static_cast<std::uint64_t>(n - s));
    std::swap(drawn_[static_cast<std::size_t>(s)], drawn_[other]);
    place(trials_.col(s), rng);
  }
  evaluate(trials_.leftCols(scouts), trial_costs_.head(scouts));
  for (Eigen::Index s = 0; s < scouts; ++s) {
    const Eigen::Index i = drawn_[static_cast<std::size_t>(s)];
    sources_.col(i) = trials_.col(s);
    costs_[i] = trial_costs_[s];
    tries_[i] = 1.0;
  }
}

void IbabcSeed::reassess(Evaluator& evaluate) { evaluate(sources_, costs_); }

}  // namespace swallowtail::swarm
