#include "planner/swarm/pareto_archive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace swallowtail::swarm {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

Eigen::VectorXd none() { return Eigen::VectorXd::Zero(1); }

TEST(Dominates, NowhereWorseAndSomewhereBetter) {
  EXPECT_TRUE(dominates(Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 3)));
  EXPECT_FALSE(dominates(Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 2)));
  EXPECT_FALSE(dominates(Eigen::Vector2d(0, 4), Eigen::Vector2d(1, 3)));
  EXPECT_TRUE(dominates(Eigen::Vector2d(0, 0), Eigen::Vector2d(kInf, 0)));
}

TEST(ParetoArchive, KeepsExactlyTheNondominatedWhileThereIsRoom) {
  Rng rng(3);
  for (int round = 0; round < 20; ++round) {
    ParetoArchive archive({.capacity = 300}, 1, 3);
    Eigen::MatrixXd points(3, 200);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      for (Eigen::Index o = 0; o < 3; ++o) points(o, i) = static_cast<double>(rng.below(12));
      archive.offer(Eigen::VectorXd::Constant(1, static_cast<double>(i)), points.col(i), rng);
    }
    std::set<std::vector<double>> expected;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      bool dominated = false;
      for (Eigen::Index j = 0; j < points.cols(); ++j) dominated |= dominates(points.col(j), points.col(i));
      if (!dominated) expected.insert({points(0, i), points(1, i), points(2, i)});
    }
    std::set<std::vector<double>> kept;
    for (Eigen::Index i = 0; i < archive.size(); ++i) {
      const Eigen::VectorXd f = archive.objectives(i);
      kept.insert({f[0], f[1], f[2]});
      EXPECT_EQ(points.col(static_cast<Eigen::Index>(archive.decision(i)[0])), f)
          << "the decision must be the one that has these objectives";
    }
    EXPECT_EQ(kept, expected);
    EXPECT_EQ(static_cast<std::size_t>(archive.size()), expected.size()) << "no point twice";
  }
}

TEST(ParetoArchive, NeverTakesWhatIsInfeasible) {
  Rng rng(1);
  ParetoArchive archive({}, 1, 2);
  EXPECT_FALSE(archive.offer(none(), Eigen::Vector2d(kInf, 0), rng));
  EXPECT_FALSE(archive.offer(none(), Eigen::Vector2d(0, std::nan("")), rng));
  EXPECT_EQ(archive.size(), 0);
}

TEST(ParetoArchive, StaysWithinItsCapacityAndThinsOutTheCrowd) {
  Rng rng(5);
  ParetoArchive archive({.capacity = 20, .divisions = 5, .crowding = 2.0}, 1, 2);
  // One member at each far end of a line, a crowd in the middle.
  archive.offer(none(), Eigen::Vector2d(0, 100), rng);
  archive.offer(none(), Eigen::Vector2d(100, 0), rng);
  for (int i = 0; i < 500; ++i) {
    const double t = rng.uniform(45.0, 55.0);
    archive.offer(none(), Eigen::Vector2d(t, 100 - t), rng);
    ASSERT_LE(archive.size(), 20);
  }
  int ends = 0;
  for (Eigen::Index i = 0; i < archive.size(); ++i) ends += std::abs(archive.objectives(i)[0] - 50) > 20;
  EXPECT_EQ(ends, 2) << "members alone in their cell outlive a crowd of 18";
}

/// Two cells, of one and three members: the document's weights e^{−κ} and e^{−3κ}.
TEST(ParetoArchive, DrawsLeadersByTheDocumentsWeights) {
  Rng rng(6);
  const double kappa = 0.5;
  ParetoArchive archive({.capacity = 10, .divisions = 2, .crowding = kappa}, 1, 2);
  archive.offer(none(), Eigen::Vector2d(0, 10), rng);
  archive.offer(none(), Eigen::Vector2d(9.8, 0.3), rng);
  archive.offer(none(), Eigen::Vector2d(9.9, 0.2), rng);
  archive.offer(none(), Eigen::Vector2d(10, 0), rng);
  ASSERT_EQ(archive.size(), 4);
  const int draws = 40000;
  std::vector<int> times(4, 0);
  for (int i = 0; i < draws; ++i) {
    const Eigen::Index leader = archive.draw_leader(rng);
    ++times[static_cast<std::size_t>(archive.objectives(leader)[0] == 0.0 ? 0 : leader == 0 ? 1 : leader)];
  }
  const double alone = std::exp(-kappa) / (std::exp(-kappa) + std::exp(-3 * kappa));
  EXPECT_NEAR(static_cast<double>(times[0]) / draws, alone, 0.015);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_NEAR(static_cast<double>(times[i]) / draws, (1 - alone) / 3, 0.015) << "evenly within a cell";
  }
}

TEST(ParetoArchive, CopesWithAnObjectiveThatNeverDiffers) {
  Rng rng(2);
  ParetoArchive archive({.capacity = 3}, 1, 3);
  for (int i = 0; i < 10; ++i) archive.offer(none(), Eigen::Vector3d(i, 10 - i, 4.0), rng);
  EXPECT_EQ(archive.size(), 3);
  EXPECT_LT(archive.draw_leader(rng), 3);
}

TEST(ParetoArchive, RefusesParametersOutOfRange) {
  EXPECT_TRUE(validate(ArchiveParams{}).ok());
  EXPECT_FALSE(validate(ArchiveParams{.capacity = 0}).ok());
  EXPECT_FALSE(validate(ArchiveParams{.divisions = 1}).ok());
  EXPECT_FALSE(validate(ArchiveParams{.crowding = -1.0}).ok());
  EXPECT_FALSE(validate(ArchiveParams{.crowding = std::nan("")}).ok());
}

}  // namespace
}  // namespace swallowtail::swarm
