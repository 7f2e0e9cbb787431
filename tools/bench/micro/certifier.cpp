#include "planner/path/certifier.hpp"

#include <benchmark/benchmark.h>

#include "tools/bench/micro/scenes.hpp"

namespace swallowtail::microbench {
namespace {

/// Five waypoints that pass the balls of ball_world at some distance.
planner::TimedPath five_waypoints(const planner::VehicleLimits& limits) {
  std::vector<planner::RoutePoint> route;
  for (const Vec3& p :
       {Vec3(0.5, 5.0, 2.0), Vec3(0.5, 10.5, 5.0), Vec3(5.0, 10.5, 10.0), Vec3(10.0, 10.0, 10.0)})
    route.push_back({p});
  return planner::time_route(Vec3::Ones(), 0.0, route, limits);
}

/// The number of balls.
void certify_among_balls(benchmark::State& state) {
  planner::VehicleLimits limits = small_aircraft();
  limits.turn_max_rad = 3.14159;
  const planner::ClearanceQuery query(ball_world(static_cast<int>(state.range(0))));
  const planner::TimedPath path = five_waypoints(limits);
  bool certified = false;
  for (auto unused : state) {
    certified = planner::certify(path, query, limits).certified;
    benchmark::DoNotOptimize(certified);
  }
  state.counters["certified"] = certified ? 1.0 : 0.0;
}
BENCHMARK(certify_among_balls)->Arg(5)->Arg(10)->Arg(20);

/// Six waypoints, high above the mountains or near them (height in metres).
void certify_over_mountains(benchmark::State& state) {
  planner::VehicleLimits limits = small_aircraft();
  limits.turn_max_rad = 3.14159;
  const auto world = mountain_world(0.25);
  const planner::ClearanceQuery query(world);
  std::vector<planner::RoutePoint> route;
  for (int i = 1; i <= 5; ++i) {
    const double at = 1.0 + 7.5 * i;
    route.push_back({Vec3(at, 39.0 - at, 0.0)});
  }
  for (auto& point : route) {
    point.position_m.z() = world->terrain().height_at(point.position_m.x(), point.position_m.y()) +
                           static_cast<double>(state.range(0));
  }
  const planner::TimedPath path =
      planner::time_route(Vec3(1.0, 38.0, static_cast<double>(state.range(0)) + 1.0), 0.0, route, limits);
  bool certified = false;
  for (auto unused : state) {
    certified = planner::certify(path, query, limits).certified;
    benchmark::DoNotOptimize(certified);
  }
  state.counters["certified"] = certified ? 1.0 : 0.0;
}
BENCHMARK(certify_over_mountains)->Arg(4)->Arg(20);

}  // namespace
}  // namespace swallowtail::microbench
