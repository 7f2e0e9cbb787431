#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>

#include "planner/swarm/registry.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define SWALLOWTAIL_COUNTS_ALLOCATIONS 0
#else
#define SWALLOWTAIL_COUNTS_ALLOCATIONS 1
#endif

namespace {
std::atomic<std::uint64_t> allocations{0};
}

#if SWALLOWTAIL_COUNTS_ALLOCATIONS
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* malloc(std::size_t size) noexcept {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
#endif

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
    if (progress.iterations == 0) before = allocations.load();
    after = allocations.load();
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
