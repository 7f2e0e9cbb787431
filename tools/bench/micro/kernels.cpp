#include <benchmark/benchmark.h>

#include "planner/kernels/batch_field.hpp"
#include "tools/bench/micro/scenes.hpp"

namespace swallowtail::microbench {
namespace {

using planner::BatchField;
using planner::kLanes;
using planner::LanePoint;
using planner::Lanes;
using planner::ObstacleField;

constexpr int kCandidates = 1024;

struct Ends {
  Vec3 start, goal;
};

LanePoint same_in_all(const Vec3& p) {
  LanePoint point;
  point.x.setConstant(p.x());
  point.y.setConstant(p.y());
  point.z.setConstant(p.z());
  return point;
}

LanePoint waypoint(const Eigen::MatrixXd& x, Eigen::Index first, Eigen::Index k) {
  LanePoint point;
  for (int lane = 0; lane < kLanes; ++lane) {
    point.x[lane] = x(3 * k, first + lane);
    point.y[lane] = x(3 * k + 1, first + lane);
    point.z[lane] = x(3 * k + 2, first + lane);
  }
  return point;
}

/// Length + penalty · violation of every column, ground included.
template <class AddHop>
void evaluate(const Eigen::MatrixXd& x, const Ends& ends, Eigen::VectorXd& costs, const AddHop& add_hop) {
  const LanePoint start = same_in_all(ends.start);
  const LanePoint goal = same_in_all(ends.goal);
  for (Eigen::Index first = 0; first < x.cols(); first += kLanes) {
    Lanes length_m = Lanes::Zero();
    Lanes violation_m = Lanes::Zero();
    LanePoint at = start;
    for (Eigen::Index k = 0; k <= x.rows() / 3; ++k) {
      const LanePoint to = k < x.rows() / 3 ? waypoint(x, first, k) : goal;
      BatchField::add_length(at, to, length_m);
      add_hop(at, to, violation_m);
      at = to;
    }
    costs.segment<kLanes>(first) = length_m + 20.0 * violation_m;
  }
}

void run(benchmark::State& state, const std::shared_ptr<const planner::World>& world,
         const Eigen::MatrixXd& x, const Ends& ends) {
  const ObstacleField field(world, small_aircraft());
  const BatchField batch(field);
  Eigen::VectorXd costs(x.cols());
  for (auto unused : state) {
    evaluate(x, ends, costs, [&](const LanePoint& a, const LanePoint& b, Lanes& sum_m) {
      batch.add_violation(a, b, sum_m);
      batch.add_terrain_violation(a, b, sum_m);
    });
    benchmark::DoNotOptimize(costs.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * x.cols());
}

const Ends kBox{Vec3::Ones(), Vec3::Constant(10.0)};
const Ends kMountains{Vec3(1.0, 1.0, 3.0), Vec3(39.0, 39.0, 25.0)};

void five_spheres_anywhere(benchmark::State& state) {
  run(state, ball_world(5), random_candidates(3, kCandidates, Vec3::Zero(), Vec3::Constant(11.0)), kBox);
}
BENCHMARK(five_spheres_anywhere);

void five_spheres_about_line(benchmark::State& state) {
  run(state, ball_world(5), candidates_about_line(3, kCandidates, kBox.start, kBox.goal, 1.5), kBox);
}
BENCHMARK(five_spheres_about_line);

/// Cell in centimetres, waypoints.
void mountains_anywhere(benchmark::State& state) {
  run(state, mountain_world(0.01 * static_cast<double>(state.range(0))),
      random_candidates(static_cast<int>(state.range(1)), kCandidates, Vec3::Zero(), Vec3(40.0, 40.0, 30.0)),
      kMountains);
}
BENCHMARK(mountains_anywhere)->ArgsProduct({{25, 50}, {6, 8}});

void mountains_about_line(benchmark::State& state) {
  run(state, mountain_world(0.01 * static_cast<double>(state.range(0))),
      candidates_about_line(static_cast<int>(state.range(1)), kCandidates, kMountains.start, kMountains.goal,
                            4.0),
      kMountains);
}
BENCHMARK(mountains_about_line)->ArgsProduct({{25, 50}, {6, 8}});

void mountains_length_below(benchmark::State& state) {
  const ObstacleField field(mountain_world(0.25), small_aircraft());
  const BatchField batch(field);
  const Eigen::MatrixXd x = random_candidates(8, kCandidates, Vec3::Zero(), Vec3(40.0, 40.0, 30.0));
  Eigen::VectorXd costs(x.cols());
  for (auto unused : state) {
    evaluate(x, kMountains, costs, [&](const LanePoint& a, const LanePoint& b, Lanes& sum_m) {
      batch.add_length_below_ground(a, b, sum_m);
    });
    benchmark::DoNotOptimize(costs.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * x.cols());
}
BENCHMARK(mountains_length_below);

/// All shapes; the number of obstacles. Six waypoints on the way across a square of 4 km.
void many_shapes(benchmark::State& state) {
  const double side_m = 4000.0;
  const auto world =
      *planner::World::make(planner::Terrain::flat(-1.0),
                            obstacles_on_hills(static_cast<int>(state.range(0)), side_m), planner::Bounds{});
  const Ends ends{Vec3(10.0, 10.0, 100.0), Vec3(side_m - 10.0, side_m - 10.0, 100.0)};
  run(state, world, candidates_about_line(6, 64, ends.start, ends.goal, 50.0), ends);
}
BENCHMARK(many_shapes)->Arg(20)->Arg(100)->Arg(1000)->Arg(10000);

/// The scalar sum over all obstacles, which the planner asks for moving ones and in local steps.
void many_shapes_scalar(benchmark::State& state) {
  const double side_m = 4000.0;
  const auto world =
      *planner::World::make(planner::Terrain::flat(-1.0),
                            obstacles_on_hills(static_cast<int>(state.range(0)), side_m), planner::Bounds{});
  const ObstacleField field(world, small_aircraft());
  const Vec3 a(10.0, 10.0, 100.0);
  const Vec3 step(400.0, 380.0, 0.0);
  int i = 0;
  for (auto unused : state) {
    const Vec3 from = a + step * (i++ % 9);
    benchmark::DoNotOptimize(field.violation_m(from, 0.0, from + step, 50.0));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(many_shapes_scalar)->Arg(20)->Arg(100)->Arg(1000)->Arg(10000);

void height_above_hills(benchmark::State& state) {
  const auto terrain = *planner::Terrain::from_grid(hill_grid(2000, 2.0));
  Rng rng(16);
  std::vector<Vec3> points;
  for (int i = 0; i < 256; ++i)
    points.push_back(Vec3(rng.uniform(0.0, 4000.0), rng.uniform(0.0, 4000.0), rng.uniform(140.0, 180.0)));
  std::size_t i = 0;
  for (auto unused : state) {
    benchmark::DoNotOptimize(terrain.min_height_above(points[i % 256], points[(i + 1) % 256]));
    ++i;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(height_above_hills);

}  // namespace
}  // namespace swallowtail::microbench
