#include "planner/swarm/ibabc.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planner/swarm/placement.hpp"

namespace swallowtail::swarm {

Parameters parameters(IbabcParams& p) {
  return {{"population", &p.population, 4, 100000, "ours"},
          {"trial_limit", &p.trial_limit, 1, 1e6, "ours"},
          {"guide", &p.guide, 0, 4, "[ZHU-KWONG]"},
          {"takes_part", &p.takes_part, 0, 1, "ours"},
          {"pressure", &p.pressure, 1, 10, "ours"}};
}

Status validate(const IbabcParams& params) {
  IbabcParams copy = params;
  return check(parameters(copy));
}

void Ibabc::init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng) {
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
  tries_.setZero(n);
  source_.resize(static_cast<std::size_t>(n));
  order_.resize(static_cast<std::size_t>(n));
  std::iota(order_.begin(), order_.end(), Eigen::Index{0});
  place_population(problem, guesses, sources_, rng);
  evaluate(sources_, costs_);
  rank();
}

void Ibabc::rank() {
  std::sort(order_.begin(), order_.end(), [this](Eigen::Index a, Eigen::Index b) {
    return costs_[a] != costs_[b] ? costs_[a] < costs_[b] : a < b;
  });
}

void Ibabc::send(Eigen::Index bee, Eigen::Index i, Rng& rng) {
  const auto n = static_cast<std::uint64_t>(sources_.cols());
  source_[static_cast<std::size_t>(bee)] = i;
  const auto k = static_cast<Eigen::Index>(rng.below(n));
  const auto l = static_cast<Eigen::Index>(rng.below(n));
  const Eigen::Index g = order_[rng.below(std::max<std::uint64_t>(1, n / 10))];
  const auto certain = static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(elements_)));
  trials_.col(bee) = sources_.col(i);
  for (Eigen::Index e = 0; e < elements_; ++e) {
    if (e != certain && !(rng.uniform() < params_.takes_part)) continue;
    for (Eigen::Index d = e * element_size_; d < (e + 1) * element_size_; ++d) {
      const double phi = rng.uniform(-1.0, 1.0);
      const double psi = rng.uniform(0.0, params_.guide);
      const double x = sources_(d, i);
      trials_(d, bee) = std::clamp(x + phi * (sources_(d, k) - sources_(d, l)) + psi * (sources_(d, g) - x),
                                   problem_.lower[d], problem_.upper[d]);
    }
  }
}

void Ibabc::evaluate_and_choose(Evaluator& evaluate) {
  evaluate(trials_, trial_costs_);
  for (Eigen::Index bee = 0; bee < trials_.cols(); ++bee) {
    const Eigen::Index i = source_[static_cast<std::size_t>(bee)];
    if (trial_costs_[bee] < costs_[i]) {
      costs_[i] = trial_costs_[bee];
      sources_.col(i) = trials_.col(bee);
      tries_[i] = 0.0;
    } else {
      tries_[i] += 1.0;
    }
  }
  rank();
}

void Ibabc::step(Evaluator& evaluate, Rng& rng) {
  const Eigen::Index n = sources_.cols();
  for (Eigen::Index bee = 0; bee < n; ++bee) send(bee, bee, rng);
  evaluate_and_choose(evaluate);
  for (Eigen::Index bee = 0; bee < n; ++bee) {
    const double rank = static_cast<double>(n) * std::pow(rng.uniform(), params_.pressure);
    send(bee, order_[static_cast<std::size_t>(rank)], rng);
  }
  evaluate_and_choose(evaluate);
  send_scout(evaluate, rng);
}

void Ibabc::send_scout(Evaluator& evaluate, Rng& rng) {
  Eigen::Index given_up = 0;
  tries_.maxCoeff(&given_up);
  if (tries_[given_up] <= params_.trial_limit || given_up == order_.front()) return;
  place_on_bow(problem_, sources_.col(given_up), rng);
  evaluate(sources_.middleCols(given_up, 1), costs_.segment(given_up, 1));
  tries_[given_up] = 0.0;
  rank();
}

void Ibabc::reassess(Evaluator& evaluate) {
  evaluate(sources_, costs_);
  rank();
}

}  // namespace swallowtail::swarm
