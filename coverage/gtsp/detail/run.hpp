#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "coverage/gtsp/detail/anchor.hpp"
#include "coverage/gtsp/detail/bound.hpp"
#include "coverage/gtsp/detail/incumbents.hpp"
#include "coverage/gtsp/detail/reduced.hpp"
#include "coverage/gtsp/detail/trial.hpp"
#include "coverage/gtsp/search/problem.hpp"

namespace swallowtail::gtsp::detail {

/// How much a mode works when nothing stops it earlier.
struct Effort {
  int trials = 1;
  int warm_trials = 1;
  double iterations_per_cluster = 0.0;  ///< of each trial
  double exact_work = 0.0;              ///< see ExactParams::work
  double kicks_per_cluster = 0.0;       ///< of the chains together; 0: trials do all the searching
  int enough_hits = 0;                  ///< see search::ChainSetup
};
Effort effort_of(Mode mode);

/// One call of solve() with valid options.
class Run {
 public:
  Run(const Instance& instance, const Options& options, const Effort& effort);
  Solution solve();

 private:
  struct Outcome {
    Found best;
    std::uint64_t iterations = 0;
  };

  bool finish_trivial();
  bool finish_unreachable();
  bool finish_exact();
  StopCondition stop_of_proofs() const;
  bool finish_by_subsets();
  bool finish_by_walks();
  void finish(const Found& best, SolveStatus status, std::string reason);
  void finish_infeasible(std::string reason);
  std::string cluster_name(int reduced_cluster) const;

  /// Whether what can be proved is worth its time before the search.
  bool is_proof_first() const;
  /// False when this search is not for the instance: arcs are missing, or clusters are few.
  bool search_by_chains();
  void search_by_trials();
  void run_trial(int index, Outcome& outcome);
  WorkTour start_of(Trial& trial, int index, const Trial::Report& report) const;
  std::optional<WorkTour> warm_start() const;
  TrialParams params_of(int index) const;
  int trial_count() const;
  void consider(Found found, std::uint64_t iteration, int index);
  double progress(int index, std::uint64_t iteration, std::uint64_t most, double begin_s) const;
  void conclude();
  bool is_proved(double cost) const { return cost <= solution_.lower_bound + rounding_; }

  const Instance& instance_;
  const Options& options_;
  Effort effort_;
  Anchor anchor_;
  Incumbents incumbents_;
  std::optional<Reduced> reduced_;
  bool is_warm_ = false;
  double rounding_ = 0.0;
  std::vector<Outcome> outcomes_;
  std::atomic<int>
      proved_trial_;  ///< lowest index of a trial that reached the bound: those after it are not needed
  Solution solution_;
};

}  // namespace swallowtail::gtsp::detail
