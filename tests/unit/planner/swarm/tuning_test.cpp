#include "planner/swarm/tuning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>

namespace swallowtail::swarm {
namespace {

/// An algorithm that is best with 30 agents, 4 midpoints and takes_part 0.25, whatever the seed.
Result<Report> known_optimum(const AnyParams& any, int midpoints, std::uint64_t seed) {
  const auto& p = std::get<AcoParams>(any);
  Report report;
  report.best_cost = 10.0 + std::abs(std::log(p.population / 25.0)) + std::abs(midpoints - 4) +
                     std::abs(p.takes_part - 0.25) + 1e-9 * static_cast<double>(seed);
  report.evaluations = 7;
  report.iterations = 3;
  for (const double extra : {5.0, 0.5, 0.001, 0.0})
    report.history.push_back({1, 0.0, report.best_cost + extra});
  return report;
}

TEST(Tuning, FindsTheBestOfWhatItTries) {
  const TuningReport report = *tune(AcoParams{}, known_optimum, {.seeds = 3});
  const auto& p = std::get<AcoParams>(report.params);
  EXPECT_EQ(p.population, 25);
  EXPECT_EQ(report.midpoints, 4);
  EXPECT_EQ(p.takes_part, 0.25);
  EXPECT_LT(report.median_after, report.median_before);
  EXPECT_EQ(report.generations, 2u) << "the third entry is within a thousandth";
  EXPECT_EQ(report.evaluations, 7 * 3 * (report.steps.size() + 1));
  EXPECT_FALSE(report.interrupted);
}

TEST(Tuning, GivesTheSameAtAnyNumberOfThreads) {
  const TuningRun sphere = [](const AnyParams& params, int midpoints, std::uint64_t seed) {
    Problem problem;
    problem.lower = Eigen::VectorXd::Constant(midpoints, -3.0);
    problem.upper = Eigen::VectorXd::Constant(midpoints, 4.0);
    problem.evaluate = [](Candidates x, Costs costs) {
      costs = 1.0 + x.colwise().squaredNorm().transpose().array();
    };
    RunOptions options;
    options.seed = seed;
    options.stop.max_evaluations = 150;
    return optimize(params, problem, options);
  };
  const AnyParams start = *params_by_name("pso");
  const TuningReport one = *tune(start, sphere, {.seeds = 5, .threads = 1});
  const TuningReport three = *tune(start, sphere, {.seeds = 5, .threads = 3});
  ASSERT_EQ(one.steps.size(), three.steps.size());
  for (std::size_t i = 0; i < one.steps.size(); ++i) {
    EXPECT_EQ(one.steps[i].median_cost, three.steps[i].median_cost);
    EXPECT_EQ(one.steps[i].kept, three.steps[i].kept);
  }
  EXPECT_LT(one.median_after, one.median_before);
}

TEST(Tuning, StopsWhenAskedWithWhatItHas) {
  std::atomic<bool> stop{false};
  TuningOptions options{.seeds = 1, .stop_requested = &stop};
  int seen = 0;
  options.observer = [&](const TuningStep&) { stop = ++seen == 4; };
  const TuningReport report = *tune(AcoParams{}, known_optimum, options);
  EXPECT_TRUE(report.interrupted);
  EXPECT_EQ(report.steps.size(), 4u);
  EXPECT_LE(report.median_after, report.median_before);
}

TEST(Tuning, PassesOnWhatTheFirstRunRefusesAndSkipsWhatLaterOnesRefuse) {
  const TuningRun never = [](const AnyParams&, int, std::uint64_t) -> Result<Report> {
    return bad_input("No.");
  };
  EXPECT_EQ(tune(AcoParams{}, never, {}).error().message, "No.");
  const TuningRun picky = [](const AnyParams& params, int midpoints, std::uint64_t seed) -> Result<Report> {
    if (midpoints != 6) return bad_input("No.");
    return known_optimum(params, midpoints, seed);
  };
  EXPECT_EQ(tune(AcoParams{}, picky, {.seeds = 1})->midpoints, 6);
  EXPECT_FALSE(tune(AcoParams{}, known_optimum, {.seeds = 0}).ok());
  EXPECT_FALSE(tune(AcoParams{}, known_optimum, {.threads = 0}).ok());
  EXPECT_FALSE(tune(AcoParams{}, known_optimum, {.midpoints = 0}).ok());
}

}  // namespace
}  // namespace swallowtail::swarm
