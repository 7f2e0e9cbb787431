#include "coverage/gtsp/solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "coverage/gtsp/check_tour.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::gtsp {
namespace {

using testing::HasSubstr;

/// `clusters` × `size` random points, those of a cluster close together.
Instance random_points(int clusters, int size, std::uint64_t seed) {
  Rng rng(seed);
  Instance::Clusters members;
  std::vector<Point> points;
  for (int c = 0; c < clusters; ++c) {
    members.emplace_back();
    const Point middle{rng.uniform(0, 10000), rng.uniform(0, 10000)};
    for (int i = 0; i < size; ++i) {
      members.back().push_back(static_cast<int>(points.size()));
      points.push_back({middle.x + rng.uniform(0, 900), middle.y + rng.uniform(0, 900)});
    }
  }
  return Instance::from_points(std::move(members), std::move(points), Metric::kEuc2D).value();
}

std::string refusal(const Options& options) {
  const Status status = validate(options, random_points(4, 2, 1));
  return status.ok() ? "accepted" : status.error().message;
}

TEST(Options, AreValidated) {
  EXPECT_EQ(refusal({}), "accepted");
  EXPECT_EQ(refusal({.fixed_prefix = {0, 2}, .start_vertex = 0, .end_vertex = 7}), "accepted");
  EXPECT_EQ(refusal({.fixed_prefix = {0, 2, 4, 6}, .end_vertex = 6}), "accepted");
  EXPECT_THAT(refusal({.fixed_prefix = {0, 1}}), HasSubstr("cluster 0 again"));
  EXPECT_THAT(refusal({.fixed_prefix = {8}}), HasSubstr("vertex 8"));
  EXPECT_THAT(refusal({.fixed_prefix = {0}, .start_vertex = 2}), HasSubstr("must agree"));
  EXPECT_THAT(refusal({.start_vertex = -1}), HasSubstr("vertex -1"));
  EXPECT_THAT(refusal({.start_vertex = 0, .end_vertex = 1}), HasSubstr("end_vertex 1"));
  EXPECT_THAT(refusal({.end_vertex = 99}), HasSubstr("vertex 99"));
  EXPECT_THAT(refusal({.threads = 0}), HasSubstr("threads is 0"));
  EXPECT_THAT(refusal({.stop = {.deadline_s = 1.0}}), HasSubstr("clock"));
  EXPECT_THAT(refusal({.stop = {.deadline_s = NAN}}), HasSubstr("not a number"));
}

TEST(Solver, SaysWhyItRefuses) {
  const Solution solution = solve(random_points(4, 2, 1), {.threads = 0});
  EXPECT_EQ(solution.status, SolveStatus::kNoneFound);
  EXPECT_THAT(solution.reason, HasSubstr("threads is 0"));
  EXPECT_TRUE(solution.tour.empty());
}

TEST(Solver, IsTheSameForASeedAtAnyThreadCount) {
  const Instance instance = random_points(40, 4, 7);
  for (const TourKind kind : {TourKind::kClosed, TourKind::kOpen}) {
    Options options{.mode = Mode::kDefault, .seed = 5, .stop = {.max_iterations = 4001}, .kind = kind};
    const Solution one = solve(instance, options);
    const Solution again = solve(instance, options);
    options.threads = 3;
    const Solution three = solve(instance, options);
    EXPECT_EQ(one.tour, again.tour);
    EXPECT_EQ(one.tour, three.tour);
    EXPECT_EQ(one.cost, three.cost);
    EXPECT_EQ(one.iterations, 4001U);
    EXPECT_EQ(three.iterations, 4001U);
  }
}

TEST(Solver, ReportsEachBetterTourAsItIsFound) {
  const Instance instance = random_points(40, 4, 8);
  std::vector<double> costs;
  Options options{.mode = Mode::kFast};
  options.on_incumbent = [&](const Incumbent& incumbent) {
    const auto checked = check_tour(instance, incumbent.tour, {});
    ASSERT_TRUE(checked.ok()) << checked.error().message;
    EXPECT_EQ(checked.value(), incumbent.cost);
    EXPECT_LT(incumbent.cost, costs.empty() ? kNoArc : costs.back());
    costs.push_back(incumbent.cost);
  };
  const Solution solution = solve(instance, options);
  ASSERT_FALSE(costs.empty());
  EXPECT_EQ(costs.back(), solution.cost);
  ASSERT_EQ(solution.history.size(), costs.size());
  EXPECT_EQ(solution.history.back().cost, solution.cost);
  EXPECT_LE(solution.lower_bound, solution.cost);
}

TEST(Solver, GivesATourEvenWhenTheDeadlineHasPassed) {
  const Instance instance = random_points(60, 5, 9);
  ManualClock clock;
  clock.advance(10.0);
  const Solution late = solve(instance, {.mode = Mode::kSlow, .stop = {.clock = &clock, .deadline_s = 1.0}});
  EXPECT_EQ(late.status, SolveStatus::kFeasible);
  EXPECT_TRUE(check_tour(instance, late.tour, {}).ok());
  const std::atomic<bool> stop{true};
  const Solution stopped = solve(instance, {.mode = Mode::kSlow, .stop = {.stop_requested = &stop}});
  EXPECT_EQ(stopped.status, SolveStatus::kInterrupted);
  EXPECT_TRUE(check_tour(instance, stopped.tour, {}).ok());
}

TEST(Solver, EndsNearADeadlineOnTheWallClock) {
  const Instance instance = random_points(100, 5, 10);
  const SteadyClock clock;
  const double begin_s = clock.now_s();
  const Solution solution =
      solve(instance, {.mode = Mode::kSlow, .stop = {.clock = &clock, .deadline_s = begin_s + 0.3}});
  EXPECT_LT(clock.now_s() - begin_s, 2.0);
  EXPECT_TRUE(check_tour(instance, solution.tour, {}).ok());
}

TEST(Solver, ProvesSmallInstancesAndKeepsTheRules) {
  const Instance instance = random_points(12, 5, 11);
  const Solution solution =
      solve(instance, {.mode = Mode::kFast, .kind = TourKind::kOpen, .start_vertex = 17, .end_vertex = 3});
  EXPECT_EQ(solution.status, SolveStatus::kOptimal);
  EXPECT_TRUE(solution.proved_optimal);
  EXPECT_EQ(solution.lower_bound, solution.cost);
  const auto checked =
      check_tour(instance, solution.tour, {.returns_to_start = false, .start = 17, .end = 3});
  ASSERT_TRUE(checked.ok()) << checked.error().message;
  EXPECT_EQ(checked.value(), solution.cost);
}

TEST(Solver, KeepsAPrefixInALargeClosedTour) {
  const Instance instance = random_points(30, 4, 12);
  const Solution solution =
      solve(instance, {.mode = Mode::kFast, .fixed_prefix = {5, 100, 40}, .end_vertex = 77});
  const auto checked = check_tour(instance, solution.tour, {.prefix = {5, 100, 40}, .end = 77});
  ASSERT_TRUE(checked.ok()) << checked.error().message;
  EXPECT_EQ(checked.value(), solution.cost);
}

TEST(Solver, RepairsAWarmTourAndNeverLosesIt) {
  const Instance instance = random_points(60, 6, 13);
  const Solution cold = solve(instance, {.mode = Mode::kFast});
  const Solution warm =
      solve(instance, {.mode = Mode::kFast, .stop = {.max_iterations = 0}, .warm_tour = cold.tour});
  EXPECT_LE(warm.cost, cold.cost);
  std::vector<int> broken(cold.tour.begin() + 10, cold.tour.end());
  broken.insert(broken.begin() + 5, {-4, 100000, broken[0]});
  const Solution repaired =
      solve(instance, {.mode = Mode::kFast, .stop = {.max_iterations = 0}, .warm_tour = broken});
  ASSERT_TRUE(check_tour(instance, repaired.tour, {}).ok());
  EXPECT_LT(repaired.cost, 1.15 * cold.cost);
  const Solution from_nothing =
      solve(instance, {.mode = Mode::kFast, .stop = {.max_iterations = 0}, .warm_tour = std::vector<int>{}});
  EXPECT_TRUE(check_tour(instance, from_nothing.tour, {}).ok());
}

TEST(Solver, TakesInstancesWithNothingToChoose) {
  const Instance single = random_points(1, 3, 14);
  EXPECT_EQ(solve(single, {}).cost, 0.0);
  EXPECT_EQ(solve(single, {.kind = TourKind::kOpen, .start_vertex = 2, .end_vertex = 2}).tour,
            std::vector<int>{2});
  const Instance pair = random_points(2, 1, 15);
  EXPECT_EQ(solve(pair, {}).cost, 2.0 * pair.cost(0, 1));
  EXPECT_EQ(solve(pair, {.fixed_prefix = {1, 0}}).cost, 2.0 * pair.cost(0, 1));
}

}  // namespace
}  // namespace swallowtail::gtsp
