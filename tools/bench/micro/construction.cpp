#include <benchmark/benchmark.h>

#include "planner/kernels/batch_field.hpp"
#include "planner/world/clearance.hpp"
#include "tools/bench/micro/scenes.hpp"

namespace swallowtail::microbench {
namespace {

/// Number of obstacles of all shapes, above flat ground.
std::vector<planner::Obstacle> obstacles(const benchmark::State& state) {
  return obstacles_on_hills(static_cast<int>(state.range(0)), 4000.0);
}

void make_world(benchmark::State& state) {
  const auto all = obstacles(state);
  for (auto unused : state) {
    auto copy = all;
    benchmark::DoNotOptimize(
        *planner::World::make(planner::Terrain::flat(0.0), std::move(copy), planner::Bounds{}));
  }
}
BENCHMARK(make_world)->Arg(5)->Arg(20)->Arg(10000);

void make_fields(benchmark::State& state) {
  const auto world = *planner::World::make(planner::Terrain::flat(0.0), obstacles(state), planner::Bounds{});
  for (auto unused : state) {
    const planner::ObstacleField field(world, small_aircraft());
    const planner::BatchField batch(field);
    benchmark::DoNotOptimize(batch.timed().data());
  }
}
BENCHMARK(make_fields)->Arg(5)->Arg(20)->Arg(10000);

void make_clearance_query(benchmark::State& state) {
  const auto world = *planner::World::make(planner::Terrain::flat(0.0), obstacles(state), planner::Bounds{});
  for (auto unused : state) {
    const planner::ClearanceQuery query(world);
    benchmark::DoNotOptimize(&query.world());
  }
}
BENCHMARK(make_clearance_query)->Arg(5)->Arg(20)->Arg(10000);

/// Samples along each side.
void make_terrain(benchmark::State& state) {
  const planner::TerrainGrid grid = hill_grid(static_cast<int>(state.range(0)), 2.0);
  for (auto unused : state) {
    state.PauseTiming();
    planner::TerrainGrid copy = grid;
    state.ResumeTiming();
    benchmark::DoNotOptimize(*planner::Terrain::from_grid(std::move(copy)));
  }
}
BENCHMARK(make_terrain)->Arg(161)->Arg(2000);

}  // namespace
}  // namespace swallowtail::microbench
