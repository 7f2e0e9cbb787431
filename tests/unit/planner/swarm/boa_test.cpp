#include "planner/swarm/boa.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "planner/swarm/driver.hpp"

namespace swallowtail::swarm {
namespace {

TEST(Boa, RefusesParametersOutOfRange) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(validate(BoaParams{}).ok());
  EXPECT_FALSE(validate(BoaParams{.population = 2}).ok());
  EXPECT_FALSE(validate(BoaParams{.switch_probability = 1.1}).ok());
  EXPECT_FALSE(validate(BoaParams{.switch_probability = kNan}).ok());
  EXPECT_FALSE(validate(BoaParams{.exponent = -0.1}).ok());
  EXPECT_FALSE(validate(BoaParams{.launcher = {.hop_share = 0.0}}).ok());
  EXPECT_FALSE(validate(BoaParams{.launcher = {.stall_iterations = 0}}).ok());
  EXPECT_FALSE(validate(BoaParams{.launcher = {.throws = 0}}).ok());
}

/// With every butterfly at one place, differences of like points are zero: nothing may move, wherever that
/// place is.
TEST(Boa, ASwarmAtOnePointStaysThere) {
  Problem problem;
  problem.lower = Eigen::VectorXd::Constant(3, -100.0);
  problem.upper = Eigen::VectorXd::Constant(3, 100.0);
  const Eigen::VectorXd place = Eigen::VectorXd::Constant(3, 60.0);
  double farthest = 0.0;
  problem.evaluate = [&](Candidates x, Costs costs) {
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      farthest = std::max(farthest, (x.col(i) - place).norm());
      costs[i] = x.col(i).squaredNorm();
    }
  };
  RunOptions options;
  options.stop.max_iterations = 50;
  options.guesses = place.replicate(1, BoaParams{}.population);
  ASSERT_TRUE(run<Boa>(BoaParams{}, problem, options).ok());
  EXPECT_EQ(farthest, 0.0);
}

/// Only the order of costs may matter: any increasing function of them gives the same search.
TEST(Boa, OnlyTheOrderOfCostsMatters) {
  Problem problem;
  problem.lower = Eigen::VectorXd::Constant(4, -1.0);
  problem.upper = Eigen::VectorXd::Constant(4, 2.0);
  problem.evaluate = [](Candidates x, Costs costs) { costs = x.colwise().squaredNorm().transpose(); };
  RunOptions options;
  options.stop.max_evaluations = 2000;
  Result<Report> plain = run<Boa>(BoaParams{}, problem, options);
  problem.evaluate = [](Candidates x, Costs costs) {
    costs = (1024.0 * x.colwise().squaredNorm().transpose()).array();
  };
  EXPECT_EQ(plain->best, run<Boa>(BoaParams{}, problem, options)->best);
}

}  // namespace
}  // namespace swallowtail::swarm
