#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/rng.hpp"
#include "tools/bench/core/convergence.hpp"
#include "tools/bench/plan/bench_case.hpp"

namespace swallowtail::bench {

/// What a document says of one experiment: where it is, what is minimised, and with how much work.
struct Experiment {
  std::string name;    ///< of the command line, and of the scenario file in data/seeds
  std::string preset;  ///< planner/cost/preset.hpp
  int population = 0;
  int iterations = 0;
  std::vector<std::string> algorithms;  ///< as published and default
};
const std::vector<Experiment>& experiments();

/// What [BOA Algorithm 5] varies.
struct Setting {
  int population = 0;
  int waypoints = 0;
  int iterations = 0;
};

/// One run of one algorithm.
struct Trial {
  double cost = 0.0;      ///< of the best path, with Step at its last value where it grows
  double length_m = 0.0;  ///< infinite when the certifier refuses the best path
  std::uint64_t evaluations = 0;
  std::uint64_t settled = 0;  ///< first iteration after which the cost stays within 0.1 % of the last one
  double first_cost = 0.0;    ///< of the first population
  double cpu_ms = 0.0;
  Curve curve;  ///< of the cost
};
/// Errors: an algorithm or preset that does not exist, a scene that does not fit it. A setting's population
/// is raised to what the algorithm needs at least.
Result<Trial> run_trial(const PlanCase& scene, const std::string& preset, const std::string& algorithm,
                        const Setting& setting, std::uint64_t seed);

/// The values that [BOA Algorithm 5] sweeps; the document prints none, these are ours.
struct SettingRange {
  std::vector<int> populations{10, 20, 50, 100};
  std::vector<int> waypoints{1, 2, 3, 5, 8};
  std::vector<int> iterations{30, 100, 300};
};
Setting random_setting(const SettingRange& range, Rng& rng);
/// [BOA Algorithm 5]: one after the other, population, midpoints and generations, each time keeping what
/// gives the least median cost over `runs` seeds from `first_seed` on. Begins in the middle of each list.
Result<Setting> greedy_setting(const PlanCase& scene, const std::string& preset, const std::string& algorithm,
                               const SettingRange& range, std::uint64_t first_seed, int runs);

}  // namespace swallowtail::bench
