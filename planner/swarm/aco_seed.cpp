#include "planner/swarm/aco_seed.hpp"

#include <algorithm>
#include <cmath>

#include "planner/swarm/placement.hpp"

namespace swallowtail::swarm {
namespace {

constexpr double kLeastPheromone = 1e-100;  // keeps numbers from vanishing

}  // namespace

Parameters parameters(AcoSeedParams& p) {
  return {{"population", &p.population, 2, 100000, "[BOA Tab. 1]"},
          {"side", &p.side, 2, 40, "ours"},
          {"pheromone_exponent", &p.pheromone_exponent, 0, 10, "[DORIGO-MANIEZZO-COLORNI]"},
          {"sight_exponent", &p.sight_exponent, 0, 10, "[DORIGO-MANIEZZO-COLORNI]"},
          {"evaporation", &p.evaporation, 0, 1, "[DORIGO-MANIEZZO-COLORNI]"}};
}

Status validate(const AcoSeedParams& params) {
  AcoSeedParams copy = params;
  return check(parameters(copy));
}

void AcoSeed::lay_out(const Problem& problem) {
  const int side = params_.side;
  const auto share = [side](Eigen::Index i) { return (static_cast<double>(i) + 0.5) / side; };
  if (!problem.waypoints) {
    for (Eigen::Index layer = 0; layer < layers_; ++layer) {
      for (Eigen::Index i = 0; i < nodes_; ++i) {
        const double s = share(i);
        places_[static_cast<std::size_t>(layer)](0, i) =
            (1.0 - s) * problem.lower[layer] + s * problem.upper[layer];
      }
    }
    return;
  }
  const LineFrame frame = frame_of(*problem.waypoints);
  for (Eigen::Index layer = 0; layer < layers_; ++layer) {
    const double s = static_cast<double>(layer + 1) / static_cast<double>(layers_ + 1);
    const Vec3 middle = (1.0 - s) * problem.waypoints->start + s * problem.waypoints->goal;
    const Vec3 lower = problem.lower.segment<3>(3 * layer);
    const Vec3 upper = problem.upper.segment<3>(3 * layer);
    const Vec3 half = 0.5 * (upper - lower);
    const Vec3 center = 0.5 * (upper + lower) - middle;
    for (Eigen::Index i = 0; i < nodes_; ++i) {
      // The box seen along the line is this wide about its centre.
      const double a = center.dot(frame.side) + (2 * share(i % side) - 1) * half.dot(frame.side.cwiseAbs());
      const double b = center.dot(frame.up) + (2 * share(i / side) - 1) * half.dot(frame.up.cwiseAbs());
      const Vec3 node = middle + a * frame.side + b * frame.up;
      places_[static_cast<std::size_t>(layer)].col(i) = node.cwiseMax(lower).cwiseMin(upper);
    }
  }
}

void AcoSeed::init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng) {
  const bool path = problem.waypoints.has_value();
  node_size_ = path ? 3 : 1;
  layers_ = problem.dimension() / node_size_;
  nodes_ = path ? params_.side * params_.side : params_.side;
  const auto layers = static_cast<std::size_t>(layers_);
  places_.assign(layers, Eigen::MatrixXd(node_size_, nodes_));
  lay_out(problem);
  pheromone_.clear();
  sight_.clear();
  for (std::size_t layer = 0; layer < layers; ++layer) {
    const Eigen::Index before = layer == 0 ? 1 : nodes_;
    pheromone_.push_back(Eigen::MatrixXd::Ones(nodes_, before));
    sight_.push_back(Eigen::MatrixXd::Ones(nodes_, before));
    if (!path) continue;
    const WaypointLayout& ends = *problem.waypoints;
    const double straight = (ends.goal - ends.start).norm();
    for (Eigen::Index from = 0; from < before; ++from) {
      const Vec3 a = layer == 0 ? ends.start : Vec3(places_[layer - 1].col(from));
      for (Eigen::Index to = 0; to < nodes_; ++to) {
        const Vec3 b = places_[layer].col(to);
        const double way = (b - a).norm() + (ends.goal - b).norm();
        sight_.back()(to, from) = std::pow(straight / std::max(way, 1e-300), params_.sight_exponent);
      }
    }
  }
  weight_ = sight_;
  ways_.setZero(layers_, params_.population);
  ants_.resize(problem.dimension(), params_.population);
  costs_.resize(params_.population);
  weigh();
  for (Eigen::Index ant = 0; ant < ants_.cols(); ++ant) walk(ant, rng);
  // A guess takes the place of an ant once; it lies on no way, so the ant's own way keeps its pheromone.
  place_guesses(problem, guesses, ants_);
  evaluate(ants_, costs_);
  costs_.head(std::min(guesses.cols(), costs_.size())).setConstant(std::numeric_limits<double>::infinity());
  deposit(evaluate.best_cost());
}

void AcoSeed::weigh() {
  for (std::size_t layer = 0; layer < weight_.size(); ++layer) {
    Eigen::MatrixXd& sums = weight_[layer];
    for (Eigen::Index from = 0; from < sums.cols(); ++from) {
      double sum = 0.0;
      for (Eigen::Index to = 0; to < sums.rows(); ++to) {
        const double tau = pheromone_[layer](to, from);
        const double alpha = params_.pheromone_exponent;
        sum += (alpha == 1.0 ? tau : std::pow(tau, alpha)) * sight_[layer](to, from);
        sums(to, from) = sum;
      }
    }
  }
}

void AcoSeed::walk(Eigen::Index ant, Rng& rng) {
  Eigen::Index from = 0;
  for (Eigen::Index layer = 0; layer < layers_; ++layer) {
    const auto sums = weight_[static_cast<std::size_t>(layer)].col(from);
    const double sum = sums[nodes_ - 1];
    auto to = static_cast<Eigen::Index>(rng.below(static_cast<std::uint64_t>(nodes_)));
    // Where all pheromone has evaporated the ant walks anywhere.
    if (sum > 0.0 && std::isfinite(sum)) {
      to = std::upper_bound(sums.begin(), sums.end(), rng.uniform() * sum) - sums.begin();
      to = std::min(to, nodes_ - 1);
    }
    ways_(layer, ant) = static_cast<int>(to);
    ants_.col(ant).segment(layer * node_size_, node_size_) = places_[static_cast<std::size_t>(layer)].col(to);
    from = to;
  }
}

void AcoSeed::deposit(double best_cost) {
  for (Eigen::MatrixXd& tau : pheromone_) {
    tau = ((1.0 - params_.evaporation) * tau.array()).max(kLeastPheromone);
  }
  for (Eigen::Index ant = 0; ant < ants_.cols(); ++ant) {
    if (!std::isfinite(costs_[ant])) continue;
    const double laid = costs_[ant] > 0.0 ? std::clamp(best_cost / costs_[ant], 0.0, 1.0) : 1.0;
    Eigen::Index from = 0;
    for (Eigen::Index layer = 0; layer < layers_; ++layer) {
      const Eigen::Index to = ways_(layer, ant);
      pheromone_[static_cast<std::size_t>(layer)](to, from) += laid;
      from = to;
    }
  }
}

void AcoSeed::step(Evaluator& evaluate, Rng& rng) {
  weigh();
  for (Eigen::Index ant = 0; ant < ants_.cols(); ++ant) walk(ant, rng);
  evaluate(ants_, costs_);
  deposit(evaluate.best_cost());
}

void AcoSeed::reassess(Evaluator&) {}  // an ant remembers no cost

}  // namespace swallowtail::swarm
