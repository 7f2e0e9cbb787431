#include "planner/swarm/smart_launcher.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace swallowtail::swarm {
namespace {

/// Three waypoints between (0, 0, 0) and (8, 0, 0); `tried` collects what is evaluated.
struct Fixture {
  explicit Fixture(std::function<double(const Eigen::VectorXd&)> cost_of) {
    problem.lower = Eigen::VectorXd::Constant(9, -10.0);
    problem.upper = Eigen::VectorXd::Constant(9, 10.0);
    problem.waypoints = WaypointLayout{Vec3::Zero(), Vec3(8, 0, 0)};
    problem.evaluate = [this, cost_of](Candidates x, Costs costs) {
      for (Eigen::Index i = 0; i < x.cols(); ++i) {
        tried.emplace_back(x.col(i));
        costs[i] = cost_of(x.col(i));
      }
    };
    agent.resize(9);
    agent << 2, 1, 0, 4, 1, 0, 6, 1, 0;
  }
  Problem problem;
  Eigen::VectorXd agent;
  std::vector<Eigen::VectorXd> tried;
};

TEST(SmartLauncher, TriesTheEightOctantsOfTheTangentFrameAndTheDrop) {
  Fixture f([](const Eigen::VectorXd&) { return 1.0; });
  SmartLauncher launcher({.hop_share = 100.0, .throws = 1});
  launcher.init(f.problem);
  Evaluator evaluate(f.problem, 1000);
  Rng rng(4);
  double cost = 0.0;
  launcher.fire(f.agent, cost, evaluate, rng);
  ASSERT_EQ(f.tried.size(), 9u);
  Eigen::Index moved = -1;
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (f.tried[0].segment<3>(3 * i) != f.agent.segment<3>(3 * i)) moved = i;
  }
  ASSERT_GE(moved, 0);
  Vec3 sum = Vec3::Zero();
  double first_length = -1.0;
  for (std::size_t d = 0; d < 8; ++d) {
    const Vec3 step = f.tried[d].segment<3>(3 * moved) - f.agent.segment<3>(3 * moved);
    sum += step;
    if (first_length < 0.0) first_length = step.norm();
    EXPECT_NEAR(step.norm(), first_length, 1e-12);
    EXPECT_GT(step.norm(), 0.0);
    for (std::size_t e = 0; e < d; ++e) {
      EXPECT_GT((f.tried[d] - f.tried[e]).norm(), first_length);
    }
  }
  EXPECT_NEAR(sum.norm(), 0.0, 1e-12);
  EXPECT_EQ(cost, 0.0) << "nothing was better";
}

TEST(SmartLauncher, MovesTheMidpointToTheBestOfTheEight) {
  Fixture f([](const Eigen::VectorXd& x) { return -x[2] - x[5] - x[8]; });  // higher is better
  SmartLauncher launcher({.hop_share = 100.0, .throws = 1});
  launcher.init(f.problem);
  Evaluator evaluate(f.problem, 1000);
  Rng rng(1);
  double cost = 0.0;
  launcher.fire(f.agent, cost, evaluate, rng);
  EXPECT_LT(cost, 0.0);
  EXPECT_DOUBLE_EQ(cost, -f.agent[2] - f.agent[5] - f.agent[8]);
  EXPECT_DOUBLE_EQ(cost, evaluate.best_cost());
}

TEST(SmartLauncher, DropsAMidpointThatIsOfNoUse) {
  Fixture f([](const Eigen::VectorXd& x) {
    double length = 0.0;
    Vec3 a = Vec3::Zero();
    for (Eigen::Index i = 0; i <= 3; ++i) {
      const Vec3 b = i < 3 ? Vec3(x.segment<3>(3 * i)) : Vec3(8, 0, 0);
      length += (b - a).norm();
      a = b;
    }
    return length;
  });
  SmartLauncher launcher({.hop_share = 100.0, .throws = 60});
  launcher.init(f.problem);
  Evaluator evaluate(f.problem, 10000);
  Rng rng(2);
  double cost = std::numeric_limits<double>::infinity();
  launcher.fire(f.agent, cost, evaluate, rng);
  EXPECT_NEAR(cost, 8.0, 1e-2) << "with all midpoints dropped the path is straight";
}

TEST(SmartLauncher, SplitsAHopBeyondTheRange) {
  // Only a path with a waypoint near (7, 3, 0), in the middle of the long last hop, is any good.
  Fixture f([](const Eigen::VectorXd& x) {
    double nearest = 100.0;
    for (Eigen::Index i = 0; i < 3; ++i)
      nearest = std::min(nearest, (x.segment<3>(3 * i) - Vec3(4.5, 0, 0)).norm());
    return nearest;
  });
  f.agent << 0.25, 0, 0, 0.5, 0, 0, 1, 0, 0;
  SmartLauncher launcher({.hop_share = 0.5, .throws = 1});
  launcher.init(f.problem);
  EXPECT_TRUE(launcher.wants_to_fire(f.agent, 0));
  Evaluator evaluate(f.problem, 1000);
  Rng rng(3);
  double cost = 3.5;
  launcher.fire(f.agent, cost, evaluate, rng);
  EXPECT_LT(cost, 2.0);
}

TEST(SmartLauncher, FiresWhenStuckAndNotBefore) {
  Fixture f([](const Eigen::VectorXd&) { return 0.0; });
  SmartLauncher launcher({.hop_share = 1.0, .stall_iterations = 3});
  launcher.init(f.problem);
  EXPECT_FALSE(launcher.wants_to_fire(f.agent, 2));
  EXPECT_TRUE(launcher.wants_to_fire(f.agent, 3));
  f.problem.waypoints.reset();
  launcher.init(f.problem);
  EXPECT_FALSE(launcher.wants_to_fire(f.agent, 3)) << "a problem without waypoints has no midpoints";
}

}  // namespace
}  // namespace swallowtail::swarm
