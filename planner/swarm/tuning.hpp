#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/swarm/registry.hpp"

namespace swallowtail::swarm {

/// One run of the algorithm with these parameters, on a path of so many midpoints. Called by several threads
/// at once; what it gives may depend on its arguments alone. Its history is needed.
using TuningRun = std::function<Result<Report>(const AnyParams& params, int midpoints, std::uint64_t seed)>;

/// One setting that was tried.
struct TuningStep {
  std::string parameter;  ///< "midpoints" or a name of parameters(AnyParams&)
  double value = 0.0;
  double median_cost = 0.0;  ///< over the seeds
  bool kept = false;
};

struct TuningOptions {
  std::uint64_t seed = 1;  ///< runs have the seeds seed … seed + seeds − 1
  int seeds = 11;          ///< 1 … 1000
  int threads = 1;         ///< 1 … 256; the result does not depend on it
  int midpoints = 6;       ///< to begin with
  int most_midpoints = 16;
  const std::atomic<bool>* stop_requested = nullptr;
  std::function<void(const TuningStep&)> observer{};  ///< may be empty; called by the calling thread
};

struct TuningReport {
  AnyParams params;
  int midpoints = 0;
  /// Iterations after which every seed's cost was within a thousandth of its final one.
  std::uint64_t generations = 0;
  double median_before = 0.0;
  double median_after = 0.0;
  std::uint64_t evaluations = 0;
  bool interrupted = false;  ///< the best so far is given
  std::vector<TuningStep> steps;
};

/// Greedy parameter search [BOA Alg. 5]: population, number of midpoints and generations first, then every
/// other parameter, one after the other; of each a few values within its range are tried with the rest
/// unchanged, and what lowers the median of the final costs is kept. Departs: the source sweeps the three in
/// nested loops and looks at one run each; generations come from the convergence curves instead of more runs,
/// since more of them never hurt a run that keeps its best. Two rounds, the second only if the first has kept
/// something. Errors: options out of range, and what `run` refuses with the first parameters; settings that
/// it refuses later count as infinitely costly.
Result<TuningReport> tune(const AnyParams& start, const TuningRun& run, const TuningOptions& options);

}  // namespace swallowtail::swarm
