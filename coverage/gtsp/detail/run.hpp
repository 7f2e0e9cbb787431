#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coverage/gtsp/detail/anchor.hpp"
#include "coverage/gtsp/detail/bound.hpp"
#include "coverage/gtsp/detail/incumbents.hpp"
#include "coverage/gtsp/detail/pruning.hpp"
#include "coverage/gtsp/search/chains.hpp"

namespace swallowtail::gtsp::detail {

/// How much a mode works when nothing stops it earlier.
struct Effort {
  double exact_work = 0.0;         ///< see ExactParams::work
  double kicks_per_cluster = 0.0;  ///< of the chains together
  int enough_hits = 0;             ///< see search::ChainSetup
};
Effort effort_of(Mode mode);

/// One call of solve() with valid options.
class Run {
 public:
  Run(const Instance& instance, const Options& options, const Effort& effort);
  Solution solve();

 private:
  bool finish_trivial();
  bool finish_unreachable();
  bool finish_exact();
  StopCondition stop_of_proofs() const;
  bool finish_by_subsets();
  bool finish_by_walks();
  void finish(const Found& best, SolveStatus status, std::string reason);
  void finish_infeasible(std::string reason);
  std::string name_of_cluster(int cluster) const;
  /// Free clusters, and one for what is fixed.
  int folded_clusters() const;

  /// Whether what can be proved is worth its time before the search.
  bool is_proof_first() const;
  void search_by_chains();
  search::ChainSetup chain_setup(const search::Problem& problem);
  void consider(Found found, std::uint64_t iteration, int chain);
  void conclude();
  bool is_proved(double cost) const { return cost <= solution_.lower_bound + rounding_; }

  const Instance& instance_;
  const Options& options_;
  Effort effort_;
  Anchor anchor_;
  Incumbents incumbents_;
  std::optional<Pruning> pruning_;
  double rounding_ = 0.0;
  std::vector<Found> found_;  ///< the best of each chain
  Solution solution_;
};

}  // namespace swallowtail::gtsp::detail
