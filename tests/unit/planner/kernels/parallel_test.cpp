#include "planner/kernels/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>

#include "planner/kernels/batch_field.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/scenes.hpp"

namespace swallowtail::planner {
namespace {

TEST(Workers, EveryColumnIsWorkedOnOnce) {
  for (const int threads : {-1, 1, 2, 3, 7}) {
    Workers workers(threads);
    EXPECT_EQ(workers.threads(), std::max(threads, 1));
    for (const Eigen::Index count : {0, 1, 7, 8, 9, 100, 1001}) {
      std::vector<std::atomic<int>> times(static_cast<std::size_t>(count));
      workers.for_ranges(count, 8, [&](Eigen::Index first, Eigen::Index last) {
        EXPECT_EQ(first % 8, 0);
        EXPECT_TRUE(last % 8 == 0 || last == count);
        for (Eigen::Index i = first; i < last; ++i) ++times[static_cast<std::size_t>(i)];
      });
      for (const auto& n : times) EXPECT_EQ(n, 1);
    }
  }
}

TEST(Workers, ShareTheWorkOut) {
  Workers workers(3);
  std::mutex mutex;
  std::set<std::thread::id> seen;
  workers.for_ranges(300, 8, [&](Eigen::Index, Eigen::Index) {
    const std::lock_guard lock(mutex);
    seen.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(seen.size(), 3U);
}

/// Hops of a batch, evaluated kLanes columns at a time: what an optimiser's step does.
class Batch {
 public:
  Batch() : field_(world(), VehicleLimits{}), batch_(field_), hops_(6, 1001), costs_(1001) {
    Rng rng(3);
    for (Eigen::Index i = 0; i < hops_.cols(); ++i) {
      hops_.col(i).head<3>() = test::random_point(rng, Vec3(-30, -30, 0), Vec3(30, 30, 30));
      hops_.col(i).tail<3>() = test::random_point(rng, Vec3(-30, -30, 0), Vec3(30, 30, 30));
    }
  }

  const Eigen::VectorXd& evaluate(Workers& workers) {
    workers.for_ranges(hops_.cols(), kLanes, [this](Eigen::Index first, Eigen::Index last) {
      for (Eigen::Index at = first; at < last; at += kLanes)
        evaluate_lanes(at, std::min<Eigen::Index>(kLanes, last - at));
    });
    return costs_;
  }

 private:
  static std::shared_ptr<const World> world() {
    Rng rng(4);
    std::vector<Obstacle> obstacles;
    for (std::uint32_t id = 1; id <= 60; ++id)
      obstacles.push_back(test::random_obstacle(rng, id, Vec3(-30, -30, 0), Vec3(30, 30, 30), 8.0));
    return *World::make(test::random_terrain(rng, Vec2(-30, -30), 60, 60, 1.0, 20.0), obstacles, Bounds{});
  }

  void evaluate_lanes(Eigen::Index first, Eigen::Index count) {
    LanePoint a, b;
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto hop = hops_.col(first + std::min<Eigen::Index>(lane, count - 1));
      a.x[lane] = hop[0], a.y[lane] = hop[1], a.z[lane] = hop[2];
      b.x[lane] = hop[3], b.y[lane] = hop[4], b.z[lane] = hop[5];
    }
    Lanes sum = Lanes::Zero();
    BatchField::add_length(a, b, sum);
    batch_.add_violation(a, b, sum);
    batch_.add_terrain_violation(a, b, sum);
    batch_.add_length_below_ground(a, b, sum);
    costs_.segment(first, count) = sum.head(count);
  }

  ObstacleField field_;
  BatchField batch_;
  Eigen::MatrixXd hops_;
  Eigen::VectorXd costs_;
};

TEST(Workers, GiveTheSameBitsAtAnyNumberOfThreads) {
  Batch batch;
  Workers alone(1);
  const Eigen::VectorXd expected = batch.evaluate(alone);
  for (const int threads : {2, 3, 5, 8}) {
    Workers workers(threads);
    for (int round = 0; round < 5; ++round) EXPECT_TRUE(batch.evaluate(workers) == expected) << threads;
  }
}

TEST(Workers, ABatchTakesNoMemory) {
  if (!SWALLOWTAIL_COUNTS_ALLOCATIONS) GTEST_SKIP() << "the sanitizer owns malloc";
  Batch batch;
  for (const int threads : {1, 3}) {
    Workers workers(threads);
    batch.evaluate(workers);
    const std::uint64_t before = test::allocations();
    ASSERT_GT(before, 0U) << "the counter must count";
    for (int round = 0; round < 20; ++round) batch.evaluate(workers);
    EXPECT_GT(before, 0U);
    EXPECT_EQ(test::allocations(), before) << threads;
  }
}

}  // namespace
}  // namespace swallowtail::planner
