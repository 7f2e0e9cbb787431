#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/rng.hpp"
#include "planner/base/stop.hpp"
#include "planner/swarm/driver.hpp"
#include "planner/swarm/multi_problem.hpp"
#include "planner/swarm/pareto_archive.hpp"

namespace swallowtail::swarm {

/// The only way an algorithm sees the problem's objectives: it counts, keeps the archive and holds the
/// budget.
class MultiEvaluator {
 public:
  MultiEvaluator(const MultiProblem& problem, const ArchiveParams& archive, std::uint64_t max_evaluations,
                 std::uint64_t seed);

  /// Objectives of the candidates, each of which is offered to the archive in order. Those beyond the budget
  /// are not evaluated and get +infinity.
  void operator()(Candidates candidates, Objectives objectives);

  std::uint64_t evaluations() const { return evaluations_; }
  const ParetoArchive& archive() const { return archive_; }
  /// Whether the archive took the candidate of that column in the last call.
  bool was_taken(Eigen::Index column) const { return taken_[static_cast<std::size_t>(column)] != 0; }
  /// The objectives have changed: what the archive holds is worth nothing any more.
  void forget_archive() { archive_.clear(); }
  /// How often the archive has taken a candidate.
  std::uint64_t accepted() const { return accepted_; }

 private:
  const MultiProblem& problem_;
  ParetoArchive archive_;
  Rng rng_;  // the archive's own, so that what it draws does not depend on what the algorithm draws
  std::uint64_t max_evaluations_;
  std::uint64_t evaluations_ = 0;
  std::uint64_t accepted_ = 0;
  std::vector<char> taken_;
};

/// As `Algorithm` (optimizer.hpp), for several objectives; `Params` has a member `archive`.
template <class A>
concept MultiAlgorithm = requires(A algorithm, const typename A::Params& params, const MultiProblem& problem,
                                  const Eigen::MatrixXd& guesses, MultiEvaluator& evaluate, Rng& rng) {
  {A(params)};
  { validate(params) } -> std::same_as<Status>;
  { params.archive } -> std::convertible_to<ArchiveParams>;
  { algorithm.init(problem, guesses, evaluate, rng) } -> std::same_as<void>;
  { algorithm.step(evaluate, rng) } -> std::same_as<void>;
};

struct MultiProgress {
  std::uint64_t iterations = 0;
  std::uint64_t evaluations = 0;
  bool improved = false;         ///< since the last call
  const ParetoArchive& archive;  ///< valid during the call
};
using MultiObserver = std::function<Advice(const MultiProgress&)>;

struct MultiHistoryEntry {
  std::uint64_t evaluations = 0;
  double elapsed_s = 0.0;    ///< 0 without a clock
  double hypervolume = 0.0;  ///< of the archive; 0 without a reference point
  Eigen::Index front_size = 0;
};

struct MultiRunOptions {
  StopCondition stop;
  std::uint64_t seed = 1;
  Eigen::MatrixXd guesses;  ///< (dimension × n) to start from; may be empty
  MultiObserver observer;   ///< may be empty
  /// A history entry each so many iterations, for the hypervolume takes time; 0: none but the last.
  std::uint64_t history_every = 10;
};

/// A set of candidates that do not dominate each other, sorted by objectives (lexicographically).
struct Front {
  Eigen::MatrixXd decisions;   ///< (dimension × size)
  Eigen::MatrixXd objectives;  ///< (objectives × size)
  Eigen::Index size() const { return decisions.cols(); }
};

struct MultiReport {
  Termination termination = Termination::kBudget;
  std::string reason;
  Front front;
  /// The column of the front that lies nearest to its ideal point, each objective taken as a share of the
  /// front's extent in it; −1 if the front is empty.
  Eigen::Index compromise = -1;
  double hypervolume = 0.0;  ///< of the front; 0 without a reference point
  std::uint64_t iterations = 0;
  std::uint64_t evaluations = 0;
  std::vector<MultiHistoryEntry> history;
};

/// (size) of each column from the front's ideal point, each objective taken as a share of the front's extent
/// in it.
Eigen::VectorXd distances_to_ideal(const Front& front);
/// The rule of MultiReport::compromise: the least of these distances.
Eigen::Index pick_compromise(const Front& front);

namespace detail {

class MultiRun {
 public:
  MultiRun(const MultiProblem& problem, const ArchiveParams& archive, const MultiRunOptions& options);

  MultiEvaluator& evaluate() { return evaluate_; }
  Rng& rng() { return rng_; }
  bool proceed();
  MultiReport finish();

 private:
  void record();

  const MultiProblem& problem_;
  const MultiRunOptions& options_;
  MultiEvaluator evaluate_;
  Rng rng_;
  MultiReport report_;
  Ending ending_;
  double started_s_ = 0.0;
  std::uint64_t accepted_before_ = 0;
};

Status check(const MultiProblem& problem, const MultiRunOptions& options);

}  // namespace detail

/// Runs an algorithm from its first population until the stop condition or the observer ends it; as `run`
/// (driver.hpp).
template <MultiAlgorithm A>
Result<MultiReport> run_multi(const typename A::Params& params, const MultiProblem& problem,
                              const MultiRunOptions& options) {
  if (Status status = detail::check(problem, options); !status) return status.error();
  if (Status status = validate(params); !status) return status.error();
  if (Status status = validate(params.archive); !status) return status.error();
  A algorithm(params);
  detail::MultiRun run(problem, params.archive, options);
  algorithm.init(problem, options.guesses, run.evaluate(), run.rng());
  while (run.proceed()) algorithm.step(run.evaluate(), run.rng());
  return run.finish();
}

}  // namespace swallowtail::swarm
