#include "planner/swarm/multi_driver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "planner/swarm/registry.hpp"

namespace swallowtail::swarm {
namespace {

/// Two paraboloids: the front is the straight line between their minima, f2 = (√2 − √f1)².
MultiProblem two_bowls() {
  MultiProblem problem;
  problem.lower = Eigen::VectorXd::Constant(4, -2.0);
  problem.upper = Eigen::VectorXd::Constant(4, 3.0);
  problem.objectives = 2;
  problem.reference = Eigen::Vector2d(5.0, 5.0);
  problem.evaluate = [](Candidates x, Objectives f) {
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      f(0, i) = x.col(i).squaredNorm();
      f(1, i) = (x.col(i).array() - 0.5).square().sum() * 2.0;
    }
  };
  return problem;
}

class MultiObjective : public ::testing::TestWithParam<std::string> {
 protected:
  MultiReport run(const MultiProblem& problem, std::uint64_t seed, std::uint64_t evaluations) const {
    MultiRunOptions options;
    options.seed = seed;
    options.stop.max_evaluations = evaluations;
    Result<MultiReport> report = optimize_multi(*params_by_name(GetParam()), problem, options);
    EXPECT_TRUE(report.ok()) << (report.ok() ? "" : report.error().message);
    return *report;
  }
};

TEST_P(MultiObjective, FindsTheFront) {
  const MultiReport report = run(two_bowls(), 1, 20000);
  ASSERT_GT(report.front.size(), 20);
  double worst = 0.0;
  for (const auto& f : report.front.objectives.colwise()) {
    // On the front √f1 + √(f2/2) = the distance of the minima, 1.
    worst = std::max(worst, std::sqrt(f[0]) + std::sqrt(f[1] / 2.0) - 1.0);
  }
  EXPECT_LT(worst, 0.1);
}

TEST_P(MultiObjective, NoMemberDominatesAnother) {
  const MultiReport report = run(two_bowls(), 2, 3000);
  for (const auto& a : report.front.objectives.colwise()) {
    for (const auto& b : report.front.objectives.colwise()) EXPECT_FALSE(dominates(a, b));
  }
  MultiProblem problem = two_bowls();
  Eigen::MatrixXd again(2, report.front.size());
  problem.evaluate(report.front.decisions, again);
  EXPECT_EQ(again, report.front.objectives);
  EXPECT_GE(report.compromise, 0);
}

TEST_P(MultiObjective, KeepsBoundsAndBudgetAndRepeatsItself) {
  MultiProblem problem = two_bowls();
  const auto inner = problem.evaluate;
  std::uint64_t spent = 0;
  problem.evaluate = [&](Candidates x, Objectives f) {
    spent += static_cast<std::uint64_t>(x.cols());
    EXPECT_TRUE((x.array() >= -2.0).all() && (x.array() <= 3.0).all());
    inner(x, f);
  };
  for (const std::uint64_t budget : {1u, 7u, 99u, 1000u}) {
    spent = 0;
    const MultiReport report = run(problem, 3, budget);
    EXPECT_EQ(spent, budget);
    EXPECT_EQ(report.evaluations, budget);
    EXPECT_EQ(report.termination, Termination::kBudget);
    EXPECT_EQ(report.front.decisions, run(two_bowls(), 3, budget).front.decisions);
  }
}

TEST_P(MultiObjective, TakesInfeasibleAndUndefinedForWhatTheyAre) {
  MultiProblem problem = two_bowls();
  const auto inner = problem.evaluate;
  problem.evaluate = [inner](Candidates x, Objectives f) {
    inner(x, f);
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      if (x(0, i) < 0.0) f(0, i) = std::nan("");
      if (x(1, i) < 0.0) f(1, i) = std::numeric_limits<double>::infinity();
    }
  };
  const MultiReport report = run(problem, 4, 3000);
  EXPECT_GT(report.front.size(), 0);
  EXPECT_TRUE((report.front.decisions.topRows(2).array() >= 0.0).all());
  problem.evaluate = [](Candidates, Objectives f) { f.setConstant(std::nan("")); };
  const MultiReport nothing = run(problem, 4, 500);
  EXPECT_EQ(nothing.front.size(), 0);
  EXPECT_EQ(nothing.compromise, -1);
  EXPECT_EQ(nothing.hypervolume, 0.0);
}

TEST_P(MultiObjective, HistoryEndsAtTheReportedHypervolume) {
  const MultiReport report = run(two_bowls(), 5, 4000);
  ASSERT_GT(report.history.size(), 2u);
  EXPECT_EQ(report.history.back().evaluations, report.evaluations);
  EXPECT_EQ(report.history.back().hypervolume, report.hypervolume);
  EXPECT_GT(report.hypervolume, report.history.front().hypervolume);
}

INSTANTIATE_TEST_SUITE_P(Registry, MultiObjective, ::testing::Values("nmopso", "nmopso-seed"),
                         [](const auto& test) { return test.param == "nmopso" ? "nmopso" : "nmopso_seed"; });

TEST(MultiDriver, PicksTheMemberNearestToTheIdealPoint) {
  Front front;
  front.decisions.resize(1, 3);
  front.objectives.resize(2, 3);
  front.objectives << 0, 100, 1000,  //
      1, 0.2, 0;
  EXPECT_EQ(pick_compromise(front), 1);
  EXPECT_EQ(pick_compromise(Front{}), -1);
}

TEST(MultiDriver, RefusesProblemsThatBreakTheRules) {
  const auto refused = [](auto change) {
    MultiProblem problem = two_bowls();
    change(problem);
    return !validate(problem).ok();
  };
  EXPECT_FALSE(refused([](MultiProblem&) {}));
  EXPECT_TRUE(refused([](MultiProblem& p) { p.objectives = 0; }));
  EXPECT_TRUE(refused([](MultiProblem& p) { p.objectives = 9; }));
  EXPECT_TRUE(refused([](MultiProblem& p) { p.reference.resize(3); }));
  EXPECT_TRUE(refused([](MultiProblem& p) { p.reference[0] = std::nan(""); }));
  EXPECT_TRUE(refused([](MultiProblem& p) { p.evaluate = nullptr; }));
  EXPECT_TRUE(refused([](MultiProblem& p) { p.upper = p.lower; }));
  EXPECT_TRUE(refused([](MultiProblem& p) {
    p.objectives = 5;
    p.reference = Eigen::VectorXd::Ones(5);
  })) << "a hypervolume of five objectives";
}

}  // namespace
}  // namespace swallowtail::swarm
