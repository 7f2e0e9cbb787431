#pragma once

#include <cstdint>
#include <string>

#include "planner/base/result.hpp"
#include "tools/bench/plan/bench_case.hpp"

/// Families of random scenes; the seed decides everything. Start and goal are free, and the straight line is
/// not.
namespace swallowtail::bench {

/// Scenario file of five Gaussian mountains and twenty balls in a box of 40 × 40 × 30 m: the size of [BOA]'s
/// scenes, from the near to the far lower corner.
std::string hills_and_balls_yaml(std::uint64_t seed);
/// Scenario file of spheres, cylinders, cones and boxes, 24 in all, in a box of 100 × 100 × 40 m.
std::string mixed_shapes_yaml(std::uint64_t seed);

/// 10,000 obstacles of four shapes over rough ground of 2000 × 2000 samples, 1 m apart; 2.5 km to fly.
Result<PlanCase> big_world(std::uint64_t seed);

}  // namespace swallowtail::bench
