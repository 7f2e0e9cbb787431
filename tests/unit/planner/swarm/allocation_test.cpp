#include <gtest/gtest.h>

#include <algorithm>

#include "planner/swarm/registry.hpp"
#include "tests/support/allocations.hpp"

namespace swallowtail::swarm {
namespace {

/// Allocations from the first to the last iteration as the observer sees them; the driver keeps no history.
class StepAllocation : public ::testing::TestWithParam<std::string> {};

TEST_P(StepAllocation, AStepTakesNoMemory) {
  if (!SWALLOWTAIL_COUNTS_ALLOCATIONS) GTEST_SKIP() << "the sanitizer owns malloc";
  Problem problem;
  problem.lower = Eigen::VectorXd::Constant(12, -10.0);
  problem.upper = Eigen::VectorXd::Constant(12, 10.0);
  problem.waypoints = WaypointLayout{Vec3(-9, 0, 0), Vec3(9, 0, 0)};
  problem.evaluate = [](Candidates x, Costs costs) {
    for (Eigen::Index i = 0; i < x.cols(); ++i) costs[i] = (x.col(i).array() - 1.0).square().sum();
  };
  std::uint64_t before = 0;
  std::uint64_t after = 0;
  RunOptions options;
  options.keep_history = false;
  options.stop.max_iterations = 200;
  options.observer = [&](const Progress& progress) {
    if (progress.iterations == 0) before = test::allocations();
    after = test::allocations();
    return Advice::kContinue;
  };
  ASSERT_TRUE(optimize(*params_by_name(GetParam()), problem, options).ok());
  ASSERT_GT(before, 0u) << "the counter must count";
  EXPECT_EQ(after, before);
}

INSTANTIATE_TEST_SUITE_P(Registry, StepAllocation, ::testing::ValuesIn(algorithm_names()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace swallowtail::swarm
