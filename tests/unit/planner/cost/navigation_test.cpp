#include "planner/cost/navigation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "planner/cost/navigation_ground.hpp"
#include "planner/scenario/public_scene.hpp"
#include "planner/swarm/registry.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Hills on a raster of 300 × 300 cells with a band of heights, threats and no luck for the straight line.
struct Scene {
  Terrain terrain = Terrain::flat(0.0);
  NavigationSpec spec;
};

Scene random_scene(std::uint64_t seed) {
  Rng rng(seed);
  TerrainGrid grid;
  grid.origin_m = Vec2(-20.0, 10.0);
  grid.cell_size_m = 2.0;
  grid.rows = 300;
  grid.cols = 300;
  grid.elevation_m.assign(300 * 300, 0.0F);
  for (int hill = 0; hill < 12; ++hill) {
    const Vec2 at(rng.uniform(0, 300), rng.uniform(0, 300));
    const double height = rng.uniform(10, 60);
    const double width = rng.uniform(15, 50);
    for (int r = 0; r < 300; ++r) {
      for (int c = 0; c < 300; ++c) {
        grid.elevation_m[static_cast<std::size_t>(r * 300 + c)] +=
            static_cast<float>(height * std::exp(-(Vec2(c, r) - at).squaredNorm() / (width * width)));
      }
    }
  }
  Scene scene;
  scene.terrain = *Terrain::from_grid(std::move(grid));
  NavigationSpec& spec = scene.spec;
  const auto above = [&](double x, double y, double h) {
    return Vec3(x, y, h + scene.terrain.height_at(x, y));
  };
  spec.box_min_m = Vec2(-20, 10);
  spec.box_max_m = Vec2(578, 608);
  spec.start_m = above(10, 40, 60);
  spec.goal_m = above(540, 560, 70);
  spec.height_min_m = 40;
  spec.height_max_m = 100;
  for (int i = 0; i < 4; ++i) {
    const Vec2 center(rng.uniform(100, 450), rng.uniform(120, 480));
    const double room =
        std::min((center - spec.start_m.head<2>()).norm(), (center - spec.goal_m.head<2>()).norm());
    spec.threats.push_back({center, std::min(rng.uniform(20, 50), 0.5 * room)});
  }
  return scene;
}

/// Everything that may be wrong with a path, found by small steps; knows nothing of how paths are made.
std::vector<std::string> violations(const Scene& scene, const std::vector<Vec3>& path) {
  const NavigationSpec& spec = scene.spec;
  std::vector<std::string> found;
  const auto complain = [&](const char* what, std::size_t j, double by) {
    found.push_back(std::string(what) + " at " + std::to_string(j) + " by " + std::to_string(by));
  };
  if (path.size() != static_cast<std::size_t>(spec.nodes) + 2) found.emplace_back("number of points");
  if (path.front() != spec.start_m) found.emplace_back("start");
  if (path.back() != spec.goal_m) found.emplace_back("goal");
  const double shortest =
      spec.segment_min_m.value_or((spec.goal_m - spec.start_m).norm() / (3.0 * spec.nodes));
  const Vec3 line = spec.goal_m - spec.start_m;
  double heading = std::atan2(line.y(), line.x());
  double climb = 0.0;
  for (std::size_t j = 0; j + 1 < path.size(); ++j) {
    const Vec3 d = path[j + 1] - path[j];
    if (d.norm() < shortest) complain("segment", j, shortest - d.norm());
    const double next_heading = std::atan2(d.y(), d.x());
    const double next_climb = std::asin(d.z() / d.norm());
    double turn = std::abs(next_heading - heading);
    turn = std::min(turn, 2.0 * std::numbers::pi - turn);
    if (turn > spec.turn_max_rad) complain("turn", j, turn - spec.turn_max_rad);
    if (std::abs(next_climb) > spec.climb_max_rad) complain("climb", j, std::abs(next_climb));
    if (std::abs(next_climb - climb) > spec.climb_max_rad) complain("change of climb", j, next_climb - climb);
    heading = next_heading;
    climb = next_climb;
    const int steps = static_cast<int>(d.norm() / 0.2) + 1;
    double low = 1e9;
    double high = -1e9;
    for (int k = 0; k <= steps; ++k) {
      const Vec3 p = path[j] + static_cast<double>(k) / steps * d;
      const double h = p.z() - scene.terrain.height_at(p.x(), p.y());
      low = std::min(low, h);
      high = std::max(high, h);
      for (const NavigationSpec::Threat& threat : spec.threats) {
        const double clear = std::hypot(p.x() - threat.center_m.x(), p.y() - threat.center_m.y()) -
                             threat.radius_m - spec.vehicle_size_m;
        if (clear < 0.0) complain("threat", j, clear);
      }
      if (p.x() < spec.box_min_m.x() || p.y() < spec.box_min_m.y() || p.x() > spec.box_max_m.x() ||
          p.y() > spec.box_max_m.y()) {
        complain("box", j, 0.0);
      }
    }
    if (low < spec.height_min_m) complain("too low", j, spec.height_min_m - low);
    if (high > spec.height_max_m) complain("too high", j, high - spec.height_max_m);
  }
  return found;
}

/// F1–F4 from their definitions, threat distances by small steps.
Eigen::Vector4d objectives_of(const Scene& scene, const std::vector<Vec3>& path) {
  const NavigationSpec& spec = scene.spec;
  double length = 0.0;
  double threat = 0.0;
  double height = 0.0;
  double turning = 0.0;
  for (std::size_t j = 0; j + 1 < path.size(); ++j) {
    const Vec3 d = path[j + 1] - path[j];
    length += d.norm();
    for (const NavigationSpec::Threat& t : spec.threats) {
      double nearest = 1e9;
      for (int k = 0; k <= 20000; ++k) {
        const Vec3 p = path[j] + k / 20000.0 * d;
        nearest = std::min(nearest, std::hypot(p.x() - t.center_m.x(), p.y() - t.center_m.y()));
      }
      threat += std::max(0.0, 1.0 - (nearest - spec.vehicle_size_m - t.radius_m) / spec.danger_distance_m);
    }
    if (j == 0) continue;
    const Vec3 before = path[j] - path[j - 1];
    turning += std::acos(std::min(1.0, before.dot(d) / before.norm() / d.norm()));
    const double h = path[j].z() - scene.terrain.height_at(path[j].x(), path[j].y());
    height += std::abs(h - 0.5 * (spec.height_min_m + spec.height_max_m)) * 2.0 /
              (spec.height_max_m - spec.height_min_m);
  }
  const auto nodes = static_cast<double>(spec.nodes);
  return {1.0 - (path.back() - path.front()).norm() / length,
          threat / static_cast<double>(spec.threats.size() * (path.size() - 1)), height / nodes,
          turning / nodes / std::numbers::pi};
}

swarm::MultiReport front_of(const NavigationProblem& problem, std::uint64_t seed, std::uint64_t evaluations) {
  Rng rng(seed);
  swarm::MultiRunOptions options;
  options.seed = seed;
  options.stop.max_evaluations = evaluations;
  options.guesses = problem.guesses(20, rng);
  return *swarm::optimize_multi(*swarm::params_by_name("nmopso"), problem.problem(), options);
}

TEST(Navigation, EveryFrontMemberKeepsEveryLimitOnEverySegment) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Scene scene = random_scene(seed);
    const NavigationProblem problem = *NavigationProblem::make(scene.terrain, scene.spec);
    const swarm::MultiReport report = front_of(problem, seed, 2000);
    ASSERT_GT(report.front.size(), 5) << "seed " << seed;
    for (Eigen::Index i = 0; i < report.front.size(); ++i) {
      const std::vector<Vec3> path = problem.polyline(report.front.decisions.col(i));
      EXPECT_EQ(violations(scene, path), std::vector<std::string>{}) << "seed " << seed << ", member " << i;
    }
  }
}

TEST(Navigation, TighterLimitsHoldAsWell) {
  for (std::uint64_t seed = 11; seed <= 13; ++seed) {
    Scene scene = random_scene(seed);
    scene.spec.turn_max_rad = 25.0 * kDegree;
    scene.spec.climb_max_rad = 15.0 * kDegree;
    scene.spec.nodes = 14;
    const NavigationProblem problem = *NavigationProblem::make(scene.terrain, scene.spec);
    const swarm::MultiReport report = front_of(problem, seed, 3000);
    ASSERT_GT(report.front.size(), 0) << "seed " << seed;
    for (Eigen::Index i = 0; i < report.front.size(); ++i) {
      const std::vector<Vec3> path = problem.polyline(report.front.decisions.col(i));
      EXPECT_EQ(violations(scene, path), std::vector<std::string>{}) << "seed " << seed << ", member " << i;
    }
  }
}

/// The checker itself must see what is wrong.
TEST(Navigation, TheCheckerFindsWhatIsBroken) {
  const Scene scene = random_scene(1);
  const NavigationProblem problem = *NavigationProblem::make(scene.terrain, scene.spec);
  const swarm::MultiReport report = front_of(problem, 1, 1000);
  const std::vector<Vec3> good = problem.polyline(report.front.decisions.col(0));
  for (const Vec3& by : {Vec3(0, 0, 60), Vec3(0, 0, -60), Vec3(200, -200, 0)}) {
    std::vector<Vec3> bad = good;
    bad[5] += by;
    EXPECT_FALSE(violations(scene, bad).empty());
  }
}

TEST(Navigation, ObjectivesAreThoseOfTheDefinitions) {
  const Scene scene = random_scene(3);
  const NavigationProblem problem = *NavigationProblem::make(scene.terrain, scene.spec);
  const swarm::MultiReport report = front_of(problem, 3, 1000);
  for (Eigen::Index i = 0; i < report.front.size(); i += 7) {
    const Eigen::Vector4d expected = objectives_of(scene, problem.polyline(report.front.decisions.col(i)));
    EXPECT_LT((report.front.objectives.col(i) - expected).cwiseAbs().maxCoeff(), 1e-5)
        << report.front.objectives.col(i).transpose() << " and " << expected.transpose();
  }
}

TEST(Navigation, APathComesBackFromItsVariables) {
  const Scene scene = random_scene(2);
  const NavigationProblem problem = *NavigationProblem::make(scene.terrain, scene.spec);
  const swarm::MultiReport report = front_of(problem, 2, 1000);
  for (Eigen::Index i = 0; i < report.front.size(); i += 5) {
    const std::vector<Vec3> path = problem.polyline(report.front.decisions.col(i));
    const std::vector<Vec3> again = problem.polyline(problem.encode(path));
    for (std::size_t j = 0; j < path.size(); ++j) EXPECT_LT((path[j] - again[j]).norm(), 1e-6);
  }
}

TEST(Navigation, TheSameSeedGivesTheSameFront) {
  const Scene scene = random_scene(4);
  const NavigationProblem problem = *NavigationProblem::make(scene.terrain, scene.spec);
  const swarm::MultiReport a = front_of(problem, 4, 1500);
  const swarm::MultiReport b = front_of(problem, 4, 1500);
  EXPECT_EQ(a.front.decisions, b.front.decisions);
  EXPECT_EQ(a.hypervolume, b.hypervolume);
  EXPECT_NE(a.front.decisions, front_of(problem, 5, 1500).front.decisions);
}

/// The excess over a band agrees with small steps along the segment, on the raster and beyond it.
TEST(NavigationGround, FindsHowFarASegmentLeavesABand) {
  const Scene scene = random_scene(9);
  Rng rng(1);
  for (int round = 0; round < 300; ++round) {
    NavigationSpec spec = scene.spec;
    const auto point = [&] {
      return Vec3(rng.uniform(-60, 620), rng.uniform(-30, 650), rng.uniform(20, 160));
    };
    const Vec3 a = point();
    const Vec3 b = round % 10 == 0 ? Vec3(a.x(), rng.uniform(0, 600), a.z()) : point();
    BandExcess expected;
    const int steps = 20000;
    for (int k = 0; k <= steps; ++k) {
      const Vec3 p = a + static_cast<double>(k) / steps * (b - a);
      const double h = p.z() - scene.terrain.height_at(p.x(), p.y());
      expected.below_m = std::max(expected.below_m, 40.0 - h);
      expected.above_m = std::max(expected.above_m, h - 100.0);
    }
    const BandExcess found = NavigationGround(scene.terrain).excess(a, b, 40.0, 100.0);
    EXPECT_NEAR(found.below_m, expected.below_m, 2e-2) << "round " << round;
    EXPECT_NEAR(found.above_m, expected.above_m, 2e-2) << "round " << round;
    EXPECT_GE(found.below_m, expected.below_m - 1e-9) << "steps can only miss";
    EXPECT_GE(found.above_m, expected.above_m - 1e-9) << "steps can only miss";
  }
}

TEST(Navigation, RefusesSpecsThatBreakTheRules) {
  const Scene scene = random_scene(1);
  const auto refused = [&](auto change) {
    NavigationSpec spec = scene.spec;
    change(spec);
    Result<NavigationProblem> problem = NavigationProblem::make(scene.terrain, spec);
    return !problem.ok() && !problem.error().message.empty();
  };
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.nodes = 0; }));
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.nodes = 1000; }));
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.turn_max_rad = 2.0; }));
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.climb_max_rad = std::nan(""); }));
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.height_max_m = s.height_min_m; }));
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.start_m.z() += 1000; }));
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.goal_m = s.start_m; }));
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.goal_m.x() = 1e6; }));
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.goal_m.x() = std::nan(""); }));
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.threats.push_back({s.start_m.head<2>(), 5.0}); }));
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.threats.push_back({Vec2(0, 0), -1.0}); }));
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.segment_min_m = 1e5; }));
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.box_max_m = s.box_min_m; }));
  EXPECT_TRUE(refused([](NavigationSpec& s) { s.danger_distance_m = 0.0; }));
}

/// The bar of the public scene; 5,000 evaluations take about 0.1 s.
TEST(Navigation, BeatsThePublicCodeOnItsScene) {
  const char* folder = std::getenv("SWALLOWTAIL_DATA");
  const std::filesystem::path data = folder != nullptr ? folder : SWALLOWTAIL_SOURCE_DIR "/../shared/data";
  const std::filesystem::path file = data / "terrain/scenarios/nmopso_sc6.txt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no data";
  Result<PublicScene> read = read_public_scene(file.string());
  ASSERT_TRUE(read.ok()) << read.error().message;
  Scene scene;
  scene.terrain = read->world->terrain();
  NavigationSpec& spec = scene.spec;
  const auto above = [&](double x, double y, double h) {
    return Vec3(x, y, h + scene.terrain.height_at(x, y));
  };
  spec.start_m = above(50, 50, 150);
  spec.goal_m = above(800, 800, 170);
  spec.box_min_m = Vec2(1, 1);
  spec.box_max_m = Vec2(923, 1001);
  spec.threats = {{Vec2(200, 230), 70}, {Vec2(600, 250), 70}, {Vec2(450, 550), 70},
                  {Vec2(700, 600), 50}, {Vec2(200, 500), 60}, {Vec2(500, 800), 60}};
  const NavigationProblem problem = *NavigationProblem::make(scene.terrain, spec);
  std::vector<double> volumes;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const swarm::MultiReport report = front_of(problem, seed, 5000);
    volumes.push_back(report.hypervolume);
    for (Eigen::Index i = 0; i < report.front.size(); ++i) {
      const std::vector<Vec3> path = problem.polyline(report.front.decisions.col(i));
      EXPECT_EQ(violations(scene, path), std::vector<std::string>{}) << "seed " << seed << ", member " << i;
    }
  }
  std::sort(volumes.begin(), volumes.end());
  EXPECT_GT(volumes[2], 0.91);
  EXPECT_GT(volumes[0], 0.90);
}

}  // namespace
}  // namespace swallowtail::planner
