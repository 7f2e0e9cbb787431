#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

#include "planner/swarm/boa.hpp"

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

TEST(BoaAllocation, AStepTakesNoMemory) {
  if (!SWALLOWTAIL_COUNTS_ALLOCATIONS) GTEST_SKIP() << "the sanitizer owns malloc";
  Problem problem;
  problem.lower = Eigen::VectorXd::Constant(12, -10.0);
  problem.upper = Eigen::VectorXd::Constant(12, 10.0);
  problem.waypoints = WaypointLayout{Vec3(-9, 0, 0), Vec3(9, 0, 0)};
  problem.evaluate = [](Candidates x, Costs costs) {
    for (Eigen::Index i = 0; i < x.cols(); ++i) costs[i] = (x.col(i).array() - 1.0).square().sum();
  };
  Evaluator evaluate(problem, 1'000'000);
  Rng rng(1);
  Boa boa(BoaParams{});
  boa.init(problem, {}, evaluate, rng);
  const std::uint64_t before = allocations.load();
  ASSERT_GT(before, 0u) << "the counter must count";
  for (int i = 0; i < 200; ++i) boa.step(evaluate, rng);
  EXPECT_EQ(allocations.load(), before);
}

}  // namespace
}  // namespace swallowtail::swarm
