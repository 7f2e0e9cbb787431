#include "planner/cost/polish.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "planner/base/rng.hpp"
#include "planner/kernels/lanes.hpp"

namespace swallowtail::planner {
namespace {

/// The strategy's constants for n variables [CMA-ES, Tab. 1].
struct Rates {
  explicit Rates(Eigen::Index dimension) : n(static_cast<double>(dimension)) {
    const int least = 4 + static_cast<int>(3.0 * std::log(n));
    samples = kLanes * ((least + kLanes - 1) / kLanes);
    parents = samples / 2;
    weights.resize(parents);
    for (int i = 0; i < parents; ++i) weights[i] = std::log(0.5 * (samples + 1)) - std::log(i + 1.0);
    weights /= weights.sum();
    mass = 1.0 / weights.squaredNorm();
    step = (mass + 2.0) / (n + mass + 5.0);
    damping = 1.0 + 2.0 * std::max(0.0, std::sqrt((mass - 1.0) / (n + 1.0)) - 1.0) + step;
    path = (4.0 + mass / n) / (n + 4.0 + 2.0 * mass / n);
    one = 2.0 / ((n + 1.3) * (n + 1.3) + mass);
    rank = std::min(1.0 - one, 2.0 * (mass - 2.0 + 1.0 / mass) / ((n + 2.0) * (n + 2.0) + mass));
    normal_length = std::sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));
    // Rounds between two decompositions of the covariance, so that these do not outweigh the sampling.
    decompose_every = std::max(1, static_cast<int>(1.0 / (4.0 * (one + rank) * std::sqrt(n))));
  }

  double n;
  int samples = 0;
  int parents = 0;
  Eigen::VectorXd weights;
  double mass = 0.0, step = 0.0, damping = 0.0, path = 0.0, one = 0.0, rank = 0.0, normal_length = 0.0;
  int decompose_every = 1;
};

class Strategy {
 public:
  Strategy(const swarm::Problem& problem, const Eigen::VectorXd& from, const PolishOptions& options)
      : problem_(problem),
        options_(options),
        rates_(from.size()),
        rng_(options.seed),
        width_(problem.upper - problem.lower),
        mean_((from - problem.lower).cwiseQuotient(width_)),
        covariance_(Eigen::MatrixXd::Identity(from.size(), from.size())),
        axes_(covariance_),
        lengths_(Eigen::VectorXd::Ones(from.size())),
        step_path_(Eigen::VectorXd::Zero(from.size())),
        path_(step_path_),
        normals_(from.size(), rates_.samples),
        moves_(normals_),
        candidates_(normals_),
        costs_(rates_.samples),
        order_(static_cast<std::size_t>(rates_.samples)),
        sigma_(options.step) {
    result_.best = from;
    Eigen::VectorXd cost(1);
    problem_.evaluate(from, cost);
    result_.cost = std::isnan(cost[0]) ? std::numeric_limits<double>::infinity() : cost[0];
    result_.evaluations = 1;
  }

  Polished run() {
    const int patience = 20 + static_cast<int>(30.0 * rates_.n / rates_.samples);
    int idle = 0;
    for (int round = 1;
         !options_.stop.reached(result_.evaluations + static_cast<std::uint64_t>(rates_.samples) - 1,
                                static_cast<std::uint64_t>(round) - 1);
         ++round) {
      const double before = result_.cost;
      sample();
      recombine(round);
      if (round % rates_.decompose_every == 0 && !decompose()) break;
      idle = before - result_.cost > 1e-9 * std::abs(before) ? 0 : idle + 1;
      if (idle > patience || sigma_ * lengths_.maxCoeff() < options_.least_step) break;
    }
    return std::move(result_);
  }

 private:
  void sample() {
    for (Eigen::Index k = 0; k < rates_.samples; ++k) {
      for (Eigen::Index i = 0; i < normals_.rows(); ++i) normals_(i, k) = rng_.normal();
    }
    moves_.noalias() = axes_ * (lengths_.asDiagonal() * normals_);
    candidates_ = (sigma_ * moves_).colwise() + mean_;
    candidates_ = candidates_.cwiseMax(0.0).cwiseMin(1.0);
    moves_ = (candidates_.colwise() - mean_) / sigma_;
    candidates_ = (width_.asDiagonal() * candidates_).colwise() + problem_.lower;
    candidates_ = candidates_.cwiseMax(problem_.lower.replicate(1, rates_.samples))
                      .cwiseMin(problem_.upper.replicate(1, rates_.samples));
    problem_.evaluate(candidates_, costs_);
    result_.evaluations += static_cast<std::uint64_t>(rates_.samples);
    for (double& cost : costs_) {
      if (std::isnan(cost)) cost = std::numeric_limits<double>::infinity();
    }
    std::iota(order_.begin(), order_.end(), Eigen::Index{0});
    std::ranges::sort(order_, [this](Eigen::Index a, Eigen::Index b) {
      return costs_[a] != costs_[b] ? costs_[a] < costs_[b] : a < b;
    });
    if (costs_[order_.front()] < result_.cost) {
      result_.cost = costs_[order_.front()];
      result_.best = candidates_.col(order_.front());
    }
  }

  void recombine(int round) {
    Eigen::VectorXd move = Eigen::VectorXd::Zero(mean_.size());
    for (int i = 0; i < rates_.parents; ++i)
      move += rates_.weights[i] * moves_.col(order_[static_cast<std::size_t>(i)]);
    mean_ += sigma_ * move;
    const Eigen::VectorXd white = axes_ * (axes_.transpose() * move).cwiseQuotient(lengths_);
    step_path_ =
        (1.0 - rates_.step) * step_path_ + std::sqrt(rates_.step * (2.0 - rates_.step) * rates_.mass) * white;
    const double travelled = step_path_.norm() / std::sqrt(1.0 - std::pow(1.0 - rates_.step, 2.0 * round));
    const bool steady = travelled < (1.4 + 2.0 / (rates_.n + 1.0)) * rates_.normal_length;
    path_ *= 1.0 - rates_.path;
    if (steady) path_ += std::sqrt(rates_.path * (2.0 - rates_.path) * rates_.mass) * move;
    const double kept =
        1.0 - rates_.one - rates_.rank + (steady ? 0.0 : rates_.one * rates_.path * (2.0 - rates_.path));
    covariance_ *= kept;
    covariance_.noalias() += rates_.one * path_ * path_.transpose();
    for (int i = 0; i < rates_.parents; ++i) {
      const auto m = moves_.col(order_[static_cast<std::size_t>(i)]);
      covariance_.noalias() += rates_.rank * rates_.weights[i] * m * m.transpose();
    }
    sigma_ *= std::exp(
        std::min(1.0, rates_.step / rates_.damping * (step_path_.norm() / rates_.normal_length - 1.0)));
  }

  bool decompose() {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance_);
    if (solver.info() != Eigen::Success || !(solver.eigenvalues()[0] > 0.0)) return false;
    axes_ = solver.eigenvectors();
    lengths_ = solver.eigenvalues().cwiseSqrt();
    return true;
  }

  const swarm::Problem& problem_;
  const PolishOptions& options_;
  Rates rates_;
  Rng rng_;
  Eigen::VectorXd width_;
  Eigen::VectorXd mean_;  ///< in shares of the box, as are moves
  Eigen::MatrixXd covariance_;
  Eigen::MatrixXd axes_;
  Eigen::VectorXd lengths_;
  Eigen::VectorXd step_path_;
  Eigen::VectorXd path_;
  Eigen::MatrixXd normals_;
  Eigen::MatrixXd moves_;
  Eigen::MatrixXd candidates_;
  Eigen::VectorXd costs_;
  std::vector<Eigen::Index> order_;
  double sigma_;
  Polished result_;
};

}  // namespace

Polished polish(const swarm::Problem& problem, const Eigen::VectorXd& from, const PolishOptions& options) {
  return Strategy(problem, from, options).run();
}

}  // namespace swallowtail::planner
