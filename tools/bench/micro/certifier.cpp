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

/// Six waypoints, as low over the mountains and balls as the certifier lets them be, by half metres.
void certify_over_mountains(benchmark::State& state) {
  planner::VehicleLimits limits = small_aircraft();
  limits.turn_max_rad = 3.14159;
  const planner::ClearanceQuery query(mountain_world(0.25));
  planner::TimedPath path;
  bool certified = false;
  for (double height_m = 0.0; !certified; height_m += 0.5) {
    std::vector<planner::RoutePoint> route;
    for (int i = 1; i <= 5; ++i) route.push_back({Vec3(1.0 + 7.5 * i, 38.0 - 7.0 * i, height_m)});
    path = planner::time_route(Vec3(1.0, 38.0, height_m), 0.0, route, limits);
    certified = planner::certify(path, query, limits).certified;
  }
  for (auto unused : state) {
    certified = planner::certify(path, query, limits).certified;
    benchmark::DoNotOptimize(certified);
  }
  state.counters["certified"] = certified ? 1.0 : 0.0;
  state.counters["height_m"] = path.front().position_m.z();
}
BENCHMARK(certify_over_mountains);

}  // namespace
}  // namespace swallowtail::microbench
