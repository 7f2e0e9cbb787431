#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "planner/base/clock.hpp"
#include "planner/base/stop.hpp"
#include "planner/swarm/optimizer.hpp"
#include "planner/swarm/problem.hpp"

namespace swallowtail::swarm {

enum class Termination : std::uint8_t { kBudget, kDeadline, kInterrupted, kAccepted, kAborted };

/// What an observer answers after an iteration: go on, stop because this is good enough, or stop and say why
/// not.
enum class Advice : std::uint8_t { kContinue, kAccept, kAbort };

struct Progress {
  std::uint64_t iterations = 0;
  std::uint64_t evaluations = 0;
  double best_cost = 0.0;
  bool improved = false;        ///< since the last call
  const Eigen::VectorXd& best;  ///< valid during the call
};
using Observer = std::function<Advice(const Progress&)>;

/// The convergence curve: one entry for each iteration, the initial population first.
struct HistoryEntry {
  std::uint64_t evaluations = 0;
  double elapsed_s = 0.0;  ///< 0 without a clock
  double best_cost = 0.0;
};

struct RunOptions {
  StopCondition stop;
  std::uint64_t seed = 1;
  Eigen::MatrixXd guesses;  ///< (dimension × n) to start from; may be empty
  Observer observer;        ///< may be empty
  bool keep_history = true;
};

struct Report {
  Termination termination = Termination::kBudget;
  std::string reason;
  Eigen::VectorXd best;
  double best_cost = 0.0;
  std::uint64_t iterations = 0;
  std::uint64_t evaluations = 0;
  std::vector<HistoryEntry> history;
};

namespace detail {

// What single- and multi-objective runs share.
Status check_box(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
Status check_start(const StopCondition& stop, const Eigen::MatrixXd& guesses, Eigen::Index dimension,
                   bool observed);
struct Ending {
  Termination termination = Termination::kBudget;
  const char* reason = "";
};
Ending ending_of(const StopCondition& stop, std::uint64_t evaluations, std::uint64_t iterations);
Ending ending_of(Advice advice);

/// The loop's bookkeeping, the same for every algorithm.
class Run {
 public:
  Run(const Problem& problem, const RunOptions& options);

  Evaluator& evaluate() { return evaluate_; }
  Rng& rng() { return rng_; }
  /// Before each iteration: true if costs are others from now on; the best has been evaluated anew then.
  bool costs_change();
  /// After each iteration: true to go on.
  bool proceed();
  Report finish();

 private:
  const Problem& problem_;
  const RunOptions& options_;
  Evaluator evaluate_;
  Rng rng_;
  Report report_;
  Ending ending_;
  double started_s_ = 0.0;
  double last_best_ = 0.0;
};

Status check(const Problem& problem, const RunOptions& options);

}  // namespace detail

/// Runs an algorithm from its first population until the stop condition or the observer ends it. A run
/// stopped by work alone depends on nothing but problem, parameters, seed and guesses. Needs a finite stop
/// condition.
template <Algorithm A>
Result<Report> run(const typename A::Params& params, const Problem& problem, const RunOptions& options) {
  if (Status status = detail::check(problem, options); !status) return status.error();
  if (Status status = validate(params); !status) return status.error();
  A algorithm(params);
  detail::Run run(problem, options);
  run.costs_change();
  algorithm.init(problem, options.guesses, run.evaluate(), run.rng());
  while (run.proceed()) {
    if (run.costs_change()) algorithm.reassess(run.evaluate());
    algorithm.step(run.evaluate(), run.rng());
  }
  return run.finish();
}

}  // namespace swallowtail::swarm
