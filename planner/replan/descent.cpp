#include "planner/replan/descent.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace swallowtail::planner {
namespace {

constexpr double kFirstWeight = 30.0;
constexpr double kWeightGrowth = 4.0;
/// Obstacles farther from a hop than this share of the distance are left out.
constexpr double kNearShare = 0.05;
constexpr std::size_t kMemory = 6;

/// The augmented Lagrangian of a path, in shares of the distance D.
class Lagrangian {
 public:
  Lagrangian(const DetourProblem& problem, std::uint64_t max_evaluations)
      : problem_(problem),
        field_(problem.field()),
        columns_(field_.size() + 1),
        multipliers_(static_cast<std::size_t>(problem.waypoints() + 1) * columns_, 0.0),
        slacks_(multipliers_.size(), 1.0),
        points_(static_cast<std::size_t>(problem.waypoints()) + 2),
        pulls_(points_.size()),
        max_evaluations_(max_evaluations) {}

  bool spent() const { return evaluations_ >= max_evaluations_; }
  std::uint64_t evaluations() const { return evaluations_; }

  double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
    ++evaluations_;
    place(x);
    for (Vec3& pull : pulls_) pull.setZero();
    double value = 0.0;
    double time_s = problem_.ends().from_time_s;
    for (std::size_t hop = 0; hop + 1 < points_.size(); ++hop) {
      const Vec3 d = points_[hop + 1] - points_[hop];
      const double length = d.norm();
      value += length / scale();
      if (length > 0.0) {
        pulls_[hop] -= d / length;
        pulls_[hop + 1] += d / length;
      }
      const double arrival_s = time_s + duration_s(d);
      value += obstacles(hop, time_s, arrival_s) + ground(hop);
      time_s = arrival_s;
    }
    gradient.resize(x.size());
    for (Eigen::Index i = 0; i < problem_.waypoints(); ++i) {
      gradient.segment<3>(3 * i) = problem_.frame().transpose() * pulls_[static_cast<std::size_t>(i) + 1];
    }
    return value;
  }

  /// With the slacks of the last evaluation.
  void tighten() {
    for (std::size_t i = 0; i < multipliers_.size(); ++i) {
      multipliers_[i] = std::max(0.0, multipliers_[i] - weight_ * slacks_[i]);
    }
    weight_ *= kWeightGrowth;
  }

 private:
  double scale() const { return problem_.distance_m(); }

  double duration_s(const Vec3& d) const {
    const VehicleLimits& limits = problem_.limits();
    const double climb = d.z() > 0.0 ? d.z() / limits.climb_speed_mps : -d.z() / limits.descent_speed_mps;
    return std::max(climb, d.norm() / limits.cruise_speed_mps);
  }

  void place(const Eigen::VectorXd& x) {
    points_.front() = problem_.ends().from_m;
    points_.back() = problem_.ends().to_m;
    for (Eigen::Index i = 0; i < problem_.waypoints(); ++i) {
      points_[static_cast<std::size_t>(i) + 1] = problem_.decode(x, i);
    }
  }

  /// Penalty of a slack, in shares of D; `force` is minus its derivative.
  double penalty(std::size_t index, double slack, double& force) {
    slacks_[index] = slack;
    force = multipliers_[index] - weight_ * slack;
    if (force <= 0.0) {
      force = 0.0;
      return -0.5 * multipliers_[index] * multipliers_[index] / weight_;
    }
    return 0.5 * (force * force - multipliers_[index] * multipliers_[index]) / weight_;
  }

  double obstacles(std::size_t hop, double t0_s, double t1_s) {
    double value = 0.0;
    for (std::size_t i = 0; i < field_.size(); ++i) {
      const std::size_t index = hop * columns_ + i;
      slacks_[index] = 1.0;
      if (!field_.near(i, points_[hop], t0_s, points_[hop + 1], t1_s, kNearShare * scale())) continue;
      const Approach approach = field_.approach(i, points_[hop], t0_s, points_[hop + 1], t1_s);
      double force = 0.0;
      value += penalty(index, (approach.signed_distance_m - field_.required_m(i)) / scale(), force);
      pulls_[hop] -= force * (1.0 - approach.fraction) * approach.normal;
      pulls_[hop + 1] -= force * approach.fraction * approach.normal;
    }
    return value;
  }

  double height_slack_m(const Vec3& a, const Vec3& b) const {
    const Terrain& terrain = field_.world().terrain();
    const double height = terrain.is_flat() ? std::min(a.z(), b.z()) - terrain.flat_elevation_m()
                                            : terrain.min_height_above(a, b);
    return height - field_.ground_clearance_m();
  }

  double ground(std::size_t hop) {
    const std::size_t index = hop * columns_ + field_.size();
    const double slack_m = height_slack_m(points_[hop], points_[hop + 1]);
    double force = 0.0;
    const double value = penalty(index, slack_m / scale(), force);
    if (force == 0.0) return value;
    const double step = 1e-4 * scale();
    for (const std::size_t end : {hop, hop + 1}) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        Vec3 a = points_[hop];
        Vec3 b = points_[hop + 1];
        (end == hop ? a : b)[axis] += step;
        pulls_[end][axis] -= force * (height_slack_m(a, b) - slack_m) / step;
      }
    }
    return value;
  }

  const DetourProblem& problem_;
  const ObstacleField& field_;
  std::size_t columns_;
  std::vector<double> multipliers_;
  std::vector<double> slacks_;
  std::vector<Vec3> points_;
  std::vector<Vec3> pulls_;
  double weight_ = kFirstWeight;
  std::uint64_t evaluations_ = 0;
  std::uint64_t max_evaluations_;
};

/// L-BFGS directions (Nocedal & Wright, Alg. 7.4).
class Curvature {
 public:
  void clear() { pairs_.clear(); }

  void add(const Eigen::VectorXd& step, const Eigen::VectorXd& change) {
    const double product = step.dot(change);
    if (product <= 1e-12 * step.norm() * change.norm()) return;
    if (pairs_.size() == kMemory) pairs_.erase(pairs_.begin());
    pairs_.push_back({step, change, 1.0 / product});
  }

  Eigen::VectorXd direction(const Eigen::VectorXd& gradient, double first_step) const {
    Eigen::VectorXd q = -gradient;
    if (pairs_.empty()) return q * (first_step / std::max(gradient.norm(), 1e-300));
    std::vector<double> shares(pairs_.size());
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      shares[i] = pairs_[i].inverse * pairs_[i].step.dot(q);
      q -= shares[i] * pairs_[i].change;
    }
    q *= 1.0 / (pairs_.back().inverse * pairs_.back().change.squaredNorm());
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      q += (shares[i] - pairs_[i].inverse * pairs_[i].change.dot(q)) * pairs_[i].step;
    }
    return q;
  }

 private:
  struct Pair {
    Eigen::VectorXd step;
    Eigen::VectorXd change;
    double inverse = 0.0;
  };
  std::vector<Pair> pairs_;
};

void minimise(Lagrangian& lagrangian, Eigen::VectorXd& x, int steps) {
  constexpr double kFirstStep = 0.01;
  constexpr double kEnough = 1e-7;
  Curvature curvature;
  Eigen::VectorXd gradient;
  Eigen::VectorXd next_gradient;
  double value = lagrangian(x, gradient);
  for (int k = 0; k < steps && !lagrangian.spent(); ++k) {
    Eigen::VectorXd direction = curvature.direction(gradient, kFirstStep);
    if (direction.dot(gradient) >= 0.0) {
      curvature.clear();
      direction = curvature.direction(gradient, kFirstStep);
    }
    const double longest = direction.cwiseAbs().maxCoeff();
    if (longest > 0.1) direction *= 0.1 / longest;
    const double slope = direction.dot(gradient);
    double share = 1.0;
    bool moved = false;
    for (int tries = 0; tries < 8 && !lagrangian.spent(); ++tries, share *= 0.4) {
      const Eigen::VectorXd next = x + share * direction;
      const double next_value = lagrangian(next, next_gradient);
      if (next_value > value + 1e-4 * share * slope) continue;
      curvature.add(next - x, next_gradient - gradient);
      const double gain = value - next_value;
      x = next;
      gradient = next_gradient;
      value = next_value;
      moved = gain > kEnough * std::abs(value);
      break;
    }
    if (!moved) return;
  }
}

}  // namespace

DescentResult descend(const DetourProblem& problem, const Eigen::VectorXd& start,
                      std::uint64_t max_evaluations, const DescentParams& params) {
  DescentResult result{start, problem.value(problem.cost(start)), 1};
  // One judgement at the start, one after each round, and one evaluation before each tightening.
  const std::uint64_t besides = 2 + 2 * static_cast<std::uint64_t>(params.rounds);
  Lagrangian lagrangian(problem, max_evaluations > besides ? max_evaluations - besides : 0);
  Eigen::VectorXd x = start;
  Eigen::VectorXd gradient;
  for (int round = 0; round < params.rounds && !lagrangian.spent(); ++round) {
    minimise(lagrangian, x, params.steps_per_round);
    if (lagrangian.spent()) break;
    lagrangian(x, gradient);
    lagrangian.tighten();
    const double value = problem.value(problem.cost(x));
    ++result.evaluations;
    if (value < result.value) {
      result.value = value;
      result.x = x;
    }
  }
  result.evaluations += lagrangian.evaluations();
  return result;
}

}  // namespace swallowtail::planner
