#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "coverage/gtsp/detail/cluster_path.hpp"
#include "coverage/gtsp/detail/insertion.hpp"
#include "coverage/gtsp/detail/removal.hpp"
#include "coverage/gtsp/detail/two_opt.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::gtsp::detail {

/// Tunables of one run of simulated annealing. All ours, by measurement on the files of [GTSPLIB].
struct TrialParams {
  std::uint64_t iterations = 0;
  int max_removed = 30;  ///< clusters taken out at once: 1 … this, and at most two thirds of the tour
  double hot = 0.3;      ///< first temperature, of the tour's mean arc
  double cold = 0.03;    ///< last temperature, likewise
  double blink = 0.01;   ///< see Inserter
};

/// One run of simulated annealing from one tour. Deterministic for its Rng as long as progress depends on
/// iterations alone.
class Trial {
 public:
  /// Given the iteration, how much of the run is over, 0 … 1; at 1 it ends.
  using Progress = std::function<double(std::uint64_t)>;
  /// Called with each tour better than all before in this run.
  using Report = std::function<void(const WorkTour&, std::uint64_t)>;

  Trial(const Reduced& reduced, const TrialParams& params, Rng rng);

  /// A tour of all clusters from nothing: the anchor or a random cluster, then the others in random order,
  /// each at its best place.
  WorkTour construct();
  /// Puts in the clusters that the tour misses and makes it a local optimum.
  void complete(WorkTour& tour);
  /// Ends when progress says so.
  void run(WorkTour start, const Progress& progress, const Report& report);
  std::uint64_t iterations() const { return iteration_; }

 private:
  /// Scores of heuristics, chosen in proportion.
  template <int kCount>
  struct Wheel {
    std::vector<double> weight = std::vector<double>(kCount, 1.0);
    std::vector<double> gain = std::vector<double>(kCount, 0.0);
    std::vector<int> used = std::vector<int>(kCount, 0);
    int spin(Rng& rng) const;
    void reward(int i, double value);
    void settle();
  };

  void polish(WorkTour& tour);
  void step(double progress, const Report& report);
  bool accepts(const Score& candidate, double temperature);
  void take_as_best(const Report& report);

  const Reduced& reduced_;
  TrialParams params_;
  Rng rng_;
  Inserter inserter_;
  Remover remover_;
  ClusterPath cluster_path_;
  TwoOpt two_opt_;
  WorkTour current_;
  WorkTour work_;
  Score best_{1 << 20, 0.0};
  Wheel<kRemovalRules> removal_wheel_;
  Wheel<kInsertionRules> insertion_wheel_;
  double mean_arc_ = 0.0;
  std::uint64_t iteration_ = 0;
};

}  // namespace swallowtail::gtsp::detail
