#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coverage/gtsp/instance.hpp"
#include "planner/base/result.hpp"
#include "planner/base/stop.hpp"

namespace swallowtail::gtsp {

/// How long the search goes on when nothing else stops it; every mode ends by itself after a number of
/// iterations, or sooner, when enough searches that began from nothing have met the same best cost.
enum class Mode { kFast, kDefault, kSlow };

/// A closed tour returns from its last vertex to its first; an open one does not.
enum class TourKind { kClosed, kOpen };

/// Largest instance given as points that is searched with something fixed: it is then held as a matrix of n×n
/// entries of 4 bytes (268 MB at the limit).
inline constexpr int kMaxSolverVertices = 8'192;

/// Largest number of clusters with Options::precedence.
inline constexpr int kMaxPrecedenceClusters = 2'000;

/// A tour that was the best so far when it was found. Tours with missing arcs are not reported.
struct Incumbent {
  const std::vector<int>& tour;
  double cost = 0.0;
  std::uint64_t iteration = 0;  ///< of the chain that found it, in its round
  double wall_s = 0.0;          ///< since solve began, on Options::stop.clock; 0 without a clock
};

struct Options {
  Mode mode = Mode::kDefault;
  std::uint64_t seed = 1;
  /// Deadline, request to stop, and limit of iterations (one iteration = one kick or one tour taken
  /// apart and put together = one evaluation). Stopped by iterations or by itself, a run is the same for a
  /// seed on every machine, whatever `threads`.
  StopCondition stop = {};
  TourKind kind = TourKind::kClosed;
  /// Where to begin instead of from nothing. It may miss clusters, name vertices twice or such as are not
  /// there, and use missing arcs: what is unusable is left out, what is missing put in. The answer is never
  /// worse than the tour so repaired.
  std::optional<std::vector<int>> warm_tour = std::nullopt;
  /// Vertices that open the tour in this order, of distinct clusters.
  std::vector<int> fixed_prefix = {};
  std::optional<int> start_vertex =
      std::nullopt;                              ///< the first of the tour; with a prefix, the prefix's first
  std::optional<int> end_vertex = std::nullopt;  ///< the last of the tour (before it returns, if closed)
  /// Pairs of clusters: the first comes before the second, counted from the tour's first vertex. At most
  /// kMaxPrecedenceClusters clusters then; searched by one thread.
  std::vector<std::pair<int, int>> precedence = {};
  /// Called for each better tour; one call at a time, from any of the threads. It must not call back into the
  /// solver.
  std::function<void(const Incumbent&)> on_incumbent = {};
  int threads = 1;  ///< 1 … 256
  /// How much work goes into the lower bound after the search, times what is usual for the mode (about a
  /// tenth of the search's); 0 … 1000. Up to 1, nothing with a warm tour; under a deadline up to a tenth of
  /// the time is kept for it.
  double bound_effort = 1.0;
};

/// Errors (kBadInput): an id out of range, a prefix with two vertices of a cluster, start or end against
/// prefix, precedence that goes in a circle or against prefix or end, too many vertices for the search, a
/// deadline without a clock.
Status validate(const Options& options, const Instance& instance);

enum class SolveStatus {
  kOptimal,      ///< the tour is proved best
  kFeasible,     ///< a tour, not proved best
  kInfeasible,   ///< proved that there is none; `reason` says why
  kNoneFound,    ///< the search ended without a tour; there may be one
  kInterrupted,  ///< stop was requested; the tour, if any, is the best so far
};

const char* name_of(SolveStatus status);

struct HistoryEntry {
  double wall_s = 0.0;
  double cost = 0.0;
};

struct Solution {
  SolveStatus status = SolveStatus::kNoneFound;
  /// One vertex of each cluster, in order; empty when none was found.
  std::vector<int> tour;
  /// Sum of the tour's arcs as the instance gives them; kNoArc without a tour.
  double cost = kNoArc;
  /// No tour costs less. Always valid; kNoArc when there is none.
  double lower_bound = 0.0;
  bool proved_optimal = false;
  std::vector<HistoryEntry> history;             ///< cost strictly falls
  std::uint64_t iterations = 0;                  ///< of all chains
  std::string reason = "solve was not called.";  ///< a sentence on how it ended
};

/// What degrees, reachability, subsets of clusters or priced walks prove first, where they are sparse or few;
/// else, and where that proves too little, chains of local kicks, local search and choice of vertices around
/// them under annealing, recombined (see search/chains.hpp); one iteration = one kick. Missing arcs are
/// counted and minimised before cost instead of weighing much; what is fixed (prefix, start, end, openness)
/// is folded into one vertex beforehand. With precedence, see detail/precedence_search.hpp. Options that
/// validate refuses give kNoneFound with the error's message as reason.
Solution solve(const Instance& instance, const Options& options);

}  // namespace swallowtail::gtsp
