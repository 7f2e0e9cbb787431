#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "planner/swarm/registry.hpp"
#include "tests/contract/optimizer/scenes.hpp"

/// What every algorithm of the registry must keep.
namespace swallowtail::swarm {
namespace {

class OptimizerContract : public ::testing::TestWithParam<std::string> {
 protected:
  AnyParams params() const { return *params_by_name(GetParam()); }

  Report run(const Problem& problem, std::uint64_t seed, std::uint64_t evaluations) const {
    RunOptions options;
    options.seed = seed;
    options.stop.max_evaluations = evaluations;
    Result<Report> report = optimize(params(), problem, options);
    EXPECT_TRUE(report.ok()) << (report.ok() ? "" : report.error().message);
    return *report;
  }

  double median_cost(const Problem& problem, std::uint64_t evaluations, int seeds) const {
    std::vector<double> costs;
    for (int seed = 1; seed <= seeds; ++seed) {
      costs.push_back(run(problem, static_cast<std::uint64_t>(seed), evaluations).best_cost);
    }
    std::sort(costs.begin(), costs.end());
    return costs[costs.size() / 2];
  }
};

TEST_P(OptimizerContract, SameSeedGivesTheSameHistory) {
  const Problem problem = scenes::corridor(4, {});
  const Report a = run(problem, 5, 3000);
  const Report b = run(problem, 5, 3000);
  ASSERT_EQ(a.history.size(), b.history.size());
  for (std::size_t i = 0; i < a.history.size(); ++i) {
    ASSERT_EQ(a.history[i].best_cost, b.history[i].best_cost);
    ASSERT_EQ(a.history[i].evaluations, b.history[i].evaluations);
  }
  EXPECT_EQ(a.best, b.best);
  EXPECT_NE(a.best, run(problem, 6, 3000).best);
}

TEST_P(OptimizerContract, HistoryNeverGetsWorseAndEndsAtTheReportedBest) {
  const Report report = run(scenes::rastrigin(5), 3, 3000);
  ASSERT_FALSE(report.history.empty());
  for (std::size_t i = 1; i < report.history.size(); ++i) {
    ASSERT_LE(report.history[i].best_cost, report.history[i - 1].best_cost);
    ASSERT_GE(report.history[i].evaluations, report.history[i - 1].evaluations);
  }
  EXPECT_EQ(report.history.back().best_cost, report.best_cost);
}

TEST_P(OptimizerContract, EveryCandidateLiesWithinTheBounds) {
  for (Problem problem : {scenes::rastrigin(7), scenes::corridor(5, {})}) {
    const auto inner = problem.evaluate;
    std::uint64_t outside = 0;
    problem.evaluate = [&](Candidates x, Costs costs) {
      for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const bool inside = (x.col(i).array() >= problem.lower.array()).all() &&
                            (x.col(i).array() <= problem.upper.array()).all();
        outside += inside ? 0 : 1;
      }
      inner(x, costs);
    };
    run(problem, 9, 4000);
    EXPECT_EQ(outside, 0u);
  }
}

TEST_P(OptimizerContract, SpendsNoMoreEvaluationsThanItMay) {
  Problem problem = scenes::corridor(3, {});
  const auto inner = problem.evaluate;
  for (const std::uint64_t budget : {1u, 7u, 25u, 100u, 1001u}) {
    std::uint64_t spent = 0;
    problem.evaluate = [&](Candidates x, Costs costs) {
      spent += static_cast<std::uint64_t>(x.cols());
      inner(x, costs);
    };
    const Report report = run(problem, 2, budget);
    EXPECT_EQ(spent, budget);
    EXPECT_EQ(report.evaluations, budget);
    EXPECT_EQ(report.termination, Termination::kBudget);
  }
}

/// What is evaluated first does not depend on how much may still come.
TEST_P(OptimizerContract, ALargerBudgetOnlyGoesOn) {
  std::vector<double> seen;
  Problem problem = scenes::corridor(4, {});
  const auto inner = problem.evaluate;
  problem.evaluate = [&](Candidates x, Costs costs) {
    inner(x, costs);
    for (Eigen::Index i = 0; i < x.cols(); ++i) seen.insert(seen.end(), x.col(i).begin(), x.col(i).end());
  };
  run(problem, 21, 2500);
  const std::vector<double> all = std::move(seen);
  for (const std::uint64_t budget : {1u, 333u, 1000u, 2499u}) {
    seen.clear();
    run(problem, 21, budget);
    ASSERT_EQ(seen.size(), 12 * budget);
    ASSERT_TRUE(std::equal(seen.begin(), seen.end(), all.begin())) << "budget " << budget;
  }
}

TEST_P(OptimizerContract, ASwarmRemembersNoCostThatHasChanged) {
  Problem problem = scenes::sphere(3);
  double offset = 0.0;
  problem.begin_iteration = [&offset](std::uint64_t iteration) {
    if (iteration != 10) return false;
    offset = 1000.0;
    return true;
  };
  const auto inner = problem.evaluate;
  problem.evaluate = [&](Candidates x, Costs costs) {
    inner(x, costs);
    costs.array() += offset;
  };
  RunOptions options;
  options.stop.max_iterations = 40;
  options.stop.max_evaluations = 100000;
  const Report report = *optimize(params(), problem, options);
  EXPECT_GE(report.best_cost, 1000.0) << "the best so far is evaluated anew";
  const double before = report.history[9].best_cost;
  EXPECT_LE(report.best_cost, before + 1000.0);
  Eigen::VectorXd cost(1);
  problem.evaluate(report.best, cost);
  EXPECT_EQ(cost[0], report.best_cost);
}

TEST_P(OptimizerContract, UsesAGoodGuess) {
  RunOptions options;
  options.stop.max_evaluations = 30;
  options.guesses = Eigen::MatrixXd::Constant(6, 1, 1.0);
  EXPECT_EQ(optimize(params(), scenes::sphere(6), options)->best_cost, 0.0);
}

TEST_P(OptimizerContract, TakesInfiniteAndUndefinedCostsAsValues) {
  Problem problem = scenes::sphere(4);
  const auto inner = problem.evaluate;
  problem.evaluate = [inner](Candidates x, Costs costs) {
    inner(x, costs);
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      if (x(0, i) < 0.0) costs[i] = std::numeric_limits<double>::quiet_NaN();
      if (x(1, i) < 0.0) costs[i] = std::numeric_limits<double>::infinity();
    }
  };
  const Report report = run(problem, 4, 5000);
  EXPECT_LT(report.best_cost, 10.0) << "a random candidate costs about 50";
  EXPECT_GE(report.best[0], 0.0);
  EXPECT_GE(report.best[1], 0.0);
}

TEST_P(OptimizerContract, ReturnsWhereNothingIsFeasible) {
  Problem problem = scenes::sphere(4);
  problem.evaluate = [](Candidates, Costs costs) {
    costs.setConstant(std::numeric_limits<double>::infinity());
  };
  EXPECT_EQ(run(problem, 4, 500).best_cost, std::numeric_limits<double>::infinity());
}

TEST_P(OptimizerContract, StopsAtTheDeadlineOrWhenAsked) {
  ManualClock clock;
  Problem problem = scenes::sphere(4);
  const auto inner = problem.evaluate;
  problem.evaluate = [&](Candidates x, Costs costs) {
    clock.advance(0.01);
    inner(x, costs);
  };
  RunOptions options;
  options.stop.clock = &clock;
  options.stop.deadline_s = 0.1;
  EXPECT_EQ(optimize(params(), problem, options)->termination, Termination::kDeadline);
  EXPECT_LT(clock.now_s(), 0.2);

  const std::atomic<bool> asked{true};
  options.stop.stop_requested = &asked;
  EXPECT_EQ(optimize(params(), problem, options)->termination, Termination::kInterrupted);
}

TEST_P(OptimizerContract, TheObserverSeesEachIterationAndDecides) {
  RunOptions options;
  options.stop.max_evaluations = 100000;
  std::uint64_t calls = 0;
  options.observer = [&](const Progress& progress) {
    EXPECT_EQ(progress.iterations, calls);
    return ++calls == 5 ? Advice::kAccept : Advice::kContinue;
  };
  Result<Report> report = optimize(params(), scenes::sphere(4), options);
  EXPECT_EQ(report->termination, Termination::kAccepted);
  EXPECT_EQ(report->iterations, 4u);
  options.observer = [](const Progress&) { return Advice::kAbort; };
  EXPECT_EQ(optimize(params(), scenes::sphere(4), options)->termination, Termination::kAborted);
}

TEST_P(OptimizerContract, RefusesProblemsThatBreakTheRules) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  RunOptions options;
  options.stop.max_evaluations = 10;
  std::vector<Problem> broken(6, scenes::sphere(4));
  broken[0].upper = broken[0].lower;
  broken[1].lower[2] = kNan;
  broken[2].upper[1] = std::numeric_limits<double>::infinity();
  broken[3].upper.resize(3);
  broken[4].evaluate = nullptr;
  broken[5].waypoints = WaypointLayout{};
  for (const Problem& problem : broken) {
    Result<Report> report = optimize(params(), problem, options);
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error().code, Error::Code::kBadInput);
    EXPECT_FALSE(report.error().message.empty());
  }
  EXPECT_FALSE(optimize(params(), Problem{}, options).ok());
}

TEST_P(OptimizerContract, RefusesBadParametersAndRunsWithoutEnd) {
  RunOptions options;
  EXPECT_FALSE(optimize(params(), scenes::sphere(4), options).ok()) << "no limit at all";
  options.stop.max_evaluations = 10;
  for (const int population : {-1, 0, 1, 1'000'000'000}) {
    EXPECT_FALSE(optimize(with_population(params(), population), scenes::sphere(4), options).ok());
  }
  options.guesses = Eigen::MatrixXd::Zero(3, 1);
  EXPECT_FALSE(optimize(params(), scenes::sphere(4), options).ok()) << "a guess of another dimension";
  options.guesses = Eigen::MatrixXd::Constant(4, 1, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(optimize(params(), scenes::sphere(4), options).ok()) << "a guess that is no number";
}

std::string test_name(const ::testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// What the default forms must keep besides; the forms as published do not (some of them cannot).
class DefaultForm : public OptimizerContract {};

TEST_P(DefaultForm, FindsTheMinimumOfSmoothAndBumpyFunctions) {
  EXPECT_LT(median_cost(scenes::sphere(6), 20000, 5), 1e-4);
  EXPECT_LT(median_cost(scenes::rastrigin(3), 20000, 5), 1.0);
}

TEST_P(DefaultForm, GoesRoundBalls) {
  const double cost = median_cost(scenes::corridor(3, {}), 10000, 7);
  EXPECT_GT(cost, 20.0);
  EXPECT_LT(cost, 21.5);
}

TEST_P(DefaultForm, AShiftedOrTurnedSceneIsAsHard) {
  const double at_origin = median_cost(scenes::corridor(3, {}), 6000, 15);
  for (const scenes::Placement& placement :
       {scenes::Placement{.shift = Vec3(100, 100, 100)}, scenes::Placement{.shift = Vec3(-3000, 20, 7)},
        scenes::Placement{.turn_rad = 0.7}, scenes::Placement{.shift = Vec3(5, 5, 5), .turn_rad = 2.0}}) {
    EXPECT_NEAR(median_cost(scenes::corridor(3, placement), 6000, 15), at_origin, 0.01 * at_origin);
  }
}

TEST_P(DefaultForm, AnotherUnitOfLengthGivesTheVerySamePath) {
  const Report metres = run(scenes::corridor(4, {}), 11, 4000);
  for (const double scale : {0x1p-10, 4.0, 0x1p20}) {
    const Report scaled = run(scenes::corridor(4, {.scale = scale}), 11, 4000);
    EXPECT_EQ(scaled.best, Eigen::VectorXd(scale * metres.best));
    EXPECT_EQ(scaled.best_cost, scale * metres.best_cost);
  }
}

/// Greatest distance of the two samples' distribution functions (Kolmogorov and Smirnov).
double distance_of_samples(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  double greatest = 0.0;
  for (const std::vector<double>* sample : {&a, &b}) {
    for (const double x : *sample) {
      const auto share = [x](const std::vector<double>& v) {
        return static_cast<double>(std::upper_bound(v.begin(), v.end(), x) - v.begin()) /
               static_cast<double>(v.size());
      };
      greatest = std::max(greatest, std::abs(share(a) - share(b)));
    }
  }
  return greatest;
}

/// 120 seeds at each place, other ones each time; the budget is short, so that results differ widely. A
/// distance beyond `critical` has a chance of 1 in 10,000 if the distributions are the same.
TEST_P(DefaultForm, PlaceTurnAndUnitDoNotChangeTheDistributionOfResults) {
  constexpr int kSeeds = 120;
  const double critical = std::sqrt(-0.5 * std::log(0.5e-4)) * std::sqrt(2.0 / kSeeds);
  std::uint64_t seed = 1000;
  const auto sample = [&](const scenes::Placement& placement, scenes::Frame frame) {
    std::vector<double> costs;
    const Problem problem = scenes::corridor(3, placement, frame);
    for (int i = 0; i < kSeeds; ++i) costs.push_back(run(problem, ++seed, 800).best_cost / placement.scale);
    return costs;
  };
  const std::vector<double> at_origin = sample({}, scenes::Frame::kOfTheScene);
  for (const scenes::Placement& placement :
       {scenes::Placement{.shift = Vec3(100, -40, 20)}, scenes::Placement{.shift = Vec3(-3000, 20, 7)},
        scenes::Placement{.turn_rad = 0.7}, scenes::Placement{.turn_rad = -2.5},
        scenes::Placement{.scale = 3.7},
        scenes::Placement{.shift = Vec3(50, 5, -5), .turn_rad = 1.3, .scale = 0.02}}) {
    for (const scenes::Frame frame : {scenes::Frame::kOfTheScene, scenes::Frame::kOfTheWorld}) {
      if (frame == scenes::Frame::kOfTheWorld && placement.turn_rad != 0.0) continue;
      EXPECT_LT(distance_of_samples(at_origin, sample(placement, frame)), critical)
          << "shift " << placement.shift.transpose() << ", turn " << placement.turn_rad << ", scale "
          << placement.scale << (frame == scenes::Frame::kOfTheWorld ? ", in the world's frame" : "");
    }
  }
}

std::vector<std::string> default_forms() {
  std::vector<std::string> names = algorithm_names();
  std::erase_if(names, [](const std::string& name) { return name.ends_with("-seed"); });
  return names;
}

INSTANTIATE_TEST_SUITE_P(Registry, OptimizerContract, ::testing::ValuesIn(algorithm_names()), test_name);
INSTANTIATE_TEST_SUITE_P(Registry, DefaultForm, ::testing::ValuesIn(default_forms()), test_name);

}  // namespace
}  // namespace swallowtail::swarm
