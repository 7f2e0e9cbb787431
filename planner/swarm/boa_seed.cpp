#include "planner/swarm/boa_seed.hpp"

#include <algorithm>
#include <cmath>

#include "planner/swarm/placement.hpp"

namespace swallowtail::swarm {

Parameters parameters(BoaSeedParams& p) {
  return {{"population", &p.population, 3, 100000, "[BOA Tab. 1]"},
          {"generations", &p.generations, 1, 1e6, "[BOA Tab. 1]"},
          {"switch_threshold", &p.switch_threshold, 0, 1, "[ARORA-SINGH]"},
          {"modality", &p.modality, 1e-6, 1, "[ARORA-SINGH]"},
          {"exponent", &p.exponent, 0, 1, "[ARORA-SINGH]"},
          {"exponent_end", &p.exponent_end, 0, 1, "[ARORA-SINGH]"},
          {"operating_range", &p.operating_range, 1e-9, 1e9, "[BOA]"}};
}

Status validate(const BoaSeedParams& params) {
  BoaSeedParams copy = params;
  return check(parameters(copy));
}

void BoaSeed::init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng) {
  const Eigen::Index n = params_.population;
  lower_ = problem.lower;
  upper_ = problem.upper;
  modality_ = params_.modality;
  exponent_ = params_.exponent;
  stalled_ = 0;
  LauncherParams launcher{.stall_iterations = 1, .throws = 1};
  if (problem.waypoints) {
    const double distance = (problem.waypoints->goal - problem.waypoints->start).norm();
    launcher.hop_share = params_.operating_range / std::max(distance, 1e-300);
  }
  launcher_ = SmartLauncher(launcher);
  launcher_.init(problem);
  butterflies_.resize(problem.dimension(), n);
  trials_.resize(problem.dimension(), n);
  costs_.resize(n);
  trial_costs_.resize(n);
  for (Eigen::Index i = place_guesses(problem, guesses, butterflies_); i < n; ++i) {
    place_anywhere(problem, butterflies_.col(i), rng);
  }
  evaluate(butterflies_, costs_);
}

void BoaSeed::step(Evaluator& evaluate, Rng& rng) {
  const auto n = static_cast<std::uint64_t>(butterflies_.cols());
  Eigen::Index best = 0;
  const double best_before = costs_.minCoeff(&best);
  double worst = 0.0;
  for (const double cost : costs_) worst = std::isfinite(cost) ? std::max(worst, cost) : worst;
  for (Eigen::Index i = 0; i < butterflies_.cols(); ++i) {
    const double smelt = std::isfinite(costs_[i]) ? std::max(costs_[i], 0.0) : worst;
    const double fragrance = modality_ * std::pow(smelt, exponent_);
    const bool switched = !launcher_.usable() || launcher_.wants_to_fire(butterflies_.col(i), stalled_);
    const bool global = rng.uniform() > params_.switch_threshold && switched;
    const double r2 = rng.uniform() * rng.uniform();
    const Eigen::Index j = global ? best : static_cast<Eigen::Index>(rng.below(n));
    const Eigen::Index k = global ? i : static_cast<Eigen::Index>(rng.below(n));
    trials_.col(i) = (butterflies_.col(i) + (r2 * butterflies_.col(j) - butterflies_.col(k)) * fragrance)
                         .cwiseMax(lower_)
                         .cwiseMin(upper_);
  }
  evaluate(trials_, trial_costs_);
  for (Eigen::Index i = 0; i < butterflies_.cols(); ++i) {
    if (trial_costs_[i] < costs_[i]) {
      costs_[i] = trial_costs_[i];
      butterflies_.col(i) = trials_.col(i);
    }
  }
  costs_.minCoeff(&best);
  if (launcher_.usable() && launcher_.wants_to_fire(butterflies_.col(best), stalled_)) {
    launcher_.fire(butterflies_.col(best), costs_[best], evaluate, rng);
  }
  stalled_ = costs_[best] < best_before ? 0 : stalled_ + 1;
  const auto generations = static_cast<double>(params_.generations);
  modality_ = std::min(1.0, modality_ + 0.025 / (modality_ * generations));
  if (exponent_ < params_.exponent_end) {
    exponent_ =
        std::min(params_.exponent_end, exponent_ + (params_.exponent_end - params_.exponent) / generations);
  }
}

void BoaSeed::reassess(Evaluator& evaluate) { evaluate(butterflies_, costs_); }

}  // namespace swallowtail::swarm
