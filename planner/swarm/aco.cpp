#include "planner/swarm/aco.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planner/swarm/placement.hpp"

namespace swallowtail::swarm {

Parameters parameters(AcoParams& p) {
  return {{"population", &p.population, 4, 100000, "[SOCHA-DORIGO]"},
          {"ants", &p.ants, 1, 100000, "[SOCHA-DORIGO]"},
          {"locality", &p.locality, 1e-4, 10, "[SOCHA-DORIGO]"},
          {"speed", &p.speed, 0.01, 4, "[SOCHA-DORIGO]"},
          {"takes_part", &p.takes_part, 0, 1, "ours"}};
}

Status validate(const AcoParams& params) {
  AcoParams copy = params;
  return check(parameters(copy));
}

void Aco::init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng) {
  const Eigen::Index k = params_.population;
  lower_ = problem.lower;
  upper_ = problem.upper;
  solutions_.resize(problem.dimension(), k);
  costs_.resize(k);
  ants_.resize(problem.dimension(), params_.ants);
  ant_costs_.resize(params_.ants);
  order_.resize(static_cast<std::size_t>(k));
  std::iota(order_.begin(), order_.end(), Eigen::Index{0});
  weight_sums_.resize(k);
  double sum = 0.0;
  for (Eigen::Index r = 0; r < k; ++r) {
    const double z = static_cast<double>(r) / (params_.locality * static_cast<double>(k));
    sum += std::exp(-0.5 * z * z);
    weight_sums_[r] = sum;
  }
  place_population(problem, guesses, solutions_, rng);
  evaluate(solutions_, costs_);
  rank();
}

void Aco::rank() {
  std::sort(order_.begin(), order_.end(), [this](Eigen::Index a, Eigen::Index b) {
    return costs_[a] != costs_[b] ? costs_[a] < costs_[b] : a < b;
  });
}

Eigen::Index Aco::draw(Rng& rng) const {
  const double u = rng.uniform() * weight_sums_[weight_sums_.size() - 1];
  const auto rank = std::upper_bound(weight_sums_.begin(), weight_sums_.end(), u) - weight_sums_.begin();
  return order_[std::min(static_cast<std::size_t>(rank), order_.size() - 1)];
}

void Aco::send(Eigen::Index ant, Rng& rng) {
  const Eigen::Index l = draw(rng);
  const auto certain = static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(ants_.rows())));
  for (Eigen::Index d = 0; d < ants_.rows(); ++d) {
    const double at = solutions_(d, l);
    ants_(d, ant) = at;
    if (d != certain && !(rng.uniform() < params_.takes_part)) continue;
    double sum = 0.0;
    for (const double other : solutions_.row(d)) sum += std::abs(other - at);
    const double sigma = params_.speed * sum / static_cast<double>(solutions_.cols() - 1);
    ants_(d, ant) = std::clamp(at + sigma * rng.normal(), lower_[d], upper_[d]);
  }
}

void Aco::step(Evaluator& evaluate, Rng& rng) {
  for (Eigen::Index ant = 0; ant < ants_.cols(); ++ant) send(ant, rng);
  evaluate(ants_, ant_costs_);
  for (Eigen::Index ant = 0; ant < ants_.cols(); ++ant) {
    Eigen::Index worst = 0;
    costs_.maxCoeff(&worst);
    if (ant_costs_[ant] < costs_[worst]) {
      costs_[worst] = ant_costs_[ant];
      solutions_.col(worst) = ants_.col(ant);
    }
  }
  rank();
}

void Aco::reassess(Evaluator& evaluate) {
  evaluate(solutions_, costs_);
  rank();
}

}  // namespace swallowtail::swarm
