#include "planner/swarm/hypervolume.hpp"

#include <gtest/gtest.h>

#include "planner/base/rng.hpp"

namespace swallowtail::swarm {
namespace {

/// Inclusion and exclusion over all subsets: the volume of a union of boxes that share a corner.
double by_inclusion_and_exclusion(const Eigen::MatrixXd& points, const Eigen::VectorXd& reference) {
  const auto n = static_cast<unsigned>(points.cols());
  double volume = 0.0;
  for (unsigned subset = 1; subset < (1u << n); ++subset) {
    Eigen::VectorXd corner = Eigen::VectorXd::Constant(points.rows(), -1e300);
    int count = 0;
    for (unsigned i = 0; i < n; ++i) {
      if ((subset >> i & 1u) == 0) continue;
      corner = corner.cwiseMax(points.col(i));
      ++count;
    }
    const double box = (reference - corner).cwiseMax(0.0).prod();
    volume += count % 2 == 1 ? box : -box;
  }
  return volume;
}

Eigen::MatrixXd random_points(Eigen::Index objectives, Eigen::Index n, bool coarse, Rng& rng) {
  Eigen::MatrixXd points(objectives, n);
  for (double& v : points.reshaped()) {
    // Coarse values collide, and some lie at or beyond the reference.
    v = coarse ? static_cast<double>(rng.below(5)) / 4.0 : rng.uniform(0.0, 1.1);
  }
  return points;
}

TEST(Hypervolume, AgreesWithInclusionAndExclusion) {
  Rng rng(7);
  for (int round = 0; round < 400; ++round) {
    const Eigen::Index m = 1 + round % 4;
    const auto n = static_cast<Eigen::Index>(rng.below(10));
    const Eigen::MatrixXd points = random_points(m, n, round % 3 == 0, rng);
    const Eigen::VectorXd reference = Eigen::VectorXd::Ones(m);
    ASSERT_NEAR(hypervolume(points, reference), by_inclusion_and_exclusion(points, reference), 1e-12)
        << "round " << round << "\n"
        << points;
  }
}

TEST(Hypervolume, ContributionsAreWhatIsLostWithoutThePoint) {
  Rng rng(8);
  for (int round = 0; round < 100; ++round) {
    const Eigen::Index m = 1 + round % 4;
    const Eigen::MatrixXd points = random_points(m, 8, round % 3 == 0, rng);
    const Eigen::VectorXd reference = Eigen::VectorXd::Ones(m);
    const Eigen::VectorXd contributions = hypervolume_contributions(points, reference);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      Eigen::MatrixXd rest(m, 7);
      for (Eigen::Index j = 0, k = 0; j < 8; ++j) {
        if (j != i) rest.col(k++) = points.col(j);
      }
      ASSERT_NEAR(contributions[i],
                  by_inclusion_and_exclusion(points, reference) - by_inclusion_and_exclusion(rest, reference),
                  1e-12);
    }
  }
}

/// A grid of cells counts the volume of larger sets, where subsets are too many.
TEST(Hypervolume, AgreesWithCountedCellsForManyPoints) {
  Rng rng(9);
  constexpr int kCells = 12;
  Eigen::MatrixXd points(4, 60);
  for (double& v : points.reshaped()) v = static_cast<double>(rng.below(kCells)) / kCells;
  int dominated = 0;
  Eigen::Vector4d cell;
  for (int c = 0; c < kCells * kCells * kCells * kCells; ++c) {
    for (int d = 0, rest = c; d < 4; ++d, rest /= kCells)
      cell[d] = static_cast<double>(rest % kCells) / kCells;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      if ((points.col(i).array() <= cell.array()).all()) {
        ++dominated;
        break;
      }
    }
  }
  EXPECT_NEAR(hypervolume(points, Eigen::Vector4d::Ones()), dominated / std::pow(kCells, 4), 1e-12);
}

TEST(Hypervolume, NothingBelowTheReferenceIsNothing) {
  EXPECT_EQ(hypervolume(Eigen::MatrixXd(3, 0), Eigen::Vector3d::Ones()), 0.0);
  EXPECT_EQ(hypervolume(Eigen::MatrixXd::Constant(3, 2, 1.0), Eigen::Vector3d::Ones()), 0.0);
}

}  // namespace
}  // namespace swallowtail::swarm
