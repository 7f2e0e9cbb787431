#include "planner/cost/polish.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace swallowtail::planner {
namespace {

swarm::Problem problem_of(Eigen::Index dimension, double (*cost)(const Eigen::VectorXd&)) {
  swarm::Problem problem;
  problem.lower = Eigen::VectorXd::Constant(dimension, -2.0);
  problem.upper = Eigen::VectorXd::Constant(dimension, 3.0);
  problem.evaluate = [cost](swarm::Candidates x, swarm::Costs costs) {
    for (Eigen::Index i = 0; i < x.cols(); ++i) costs[i] = cost(x.col(i));
  };
  return problem;
}

PolishOptions evaluations(std::uint64_t count) {
  PolishOptions options;
  options.stop.max_evaluations = count;
  return options;
}

double valley(const Eigen::VectorXd& x) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i + 1 < x.size(); ++i) {
    sum += 100.0 * std::pow(x[i + 1] - x[i] * x[i], 2.0) + std::pow(1.0 - x[i], 2.0);
  }
  return sum;
}

/// A kink along a slanting line and a step beyond it: no gradient would do.
double kinked(const Eigen::VectorXd& x) {
  const double side = x.sum() - 1.0;
  return (x.array() - 0.5).square().sum() + 5.0 * std::abs(side) + (side < 0.0 ? 3.0 : 0.0);
}

TEST(Polish, FollowsACurvedValleyToItsEnd) {
  const swarm::Problem problem = problem_of(9, valley);
  const Polished polished = polish(problem, Eigen::VectorXd::Zero(9), evaluations(20'000));
  EXPECT_LT(polished.cost, 1e-6);
  EXPECT_LT((polished.best.array() - 1.0).abs().maxCoeff(), 1e-2);
}

TEST(Polish, NeedsNoSlope) {
  const swarm::Problem problem = problem_of(6, kinked);
  const Polished polished = polish(problem, Eigen::VectorXd::Constant(6, 1.0), evaluations(20'000));
  // On the line every variable is 1/6.
  EXPECT_NEAR(polished.cost, 6.0 / 9.0, 1e-3);
}

TEST(Polish, StaysInTheBoxAndNeverGetsWorse) {
  const swarm::Problem problem = problem_of(4, [](const Eigen::VectorXd& x) {
    if (x.minCoeff() < -2.0 || x.maxCoeff() > 3.0) return std::numeric_limits<double>::quiet_NaN();
    return -x.sum();
  });
  const Polished polished = polish(problem, Eigen::VectorXd::Zero(4), evaluations(3'000));
  EXPECT_NEAR(polished.cost, -12.0, 1e-6);
  const Polished again = polish(problem, Eigen::VectorXd::Constant(4, 3.0), evaluations(100));
  EXPECT_EQ(again.cost, -12.0);
}

TEST(Polish, KeepsToTheEvaluationsAndTheSeed) {
  const swarm::Problem problem = problem_of(9, valley);
  const Polished a = polish(problem, Eigen::VectorXd::Zero(9), evaluations(500));
  const Polished b = polish(problem, Eigen::VectorXd::Zero(9), evaluations(500));
  EXPECT_LE(a.evaluations, 500u);
  EXPECT_EQ(a.best, b.best);
  EXPECT_LT(a.cost, 8.0);
  EXPECT_EQ(polish(problem, Eigen::VectorXd::Zero(9), evaluations(1)).evaluations, 1u);
}

}  // namespace
}  // namespace swallowtail::planner
