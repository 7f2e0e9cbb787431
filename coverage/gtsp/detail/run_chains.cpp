#include <algorithm>
#include <limits>

#include "coverage/gtsp/detail/pruning.hpp"
#include "coverage/gtsp/detail/run.hpp"
#include "coverage/gtsp/search/chains.hpp"
#include "coverage/gtsp/search/warm_tour.hpp"

namespace swallowtail::gtsp::detail {
namespace {

/// A warm search has so much less work to do.
constexpr double kWarmShare = 8.0;
/// Beyond it the bound's tables would take longer than the search and more memory.
constexpr int kMaxBoundVertices = 3'000;

}  // namespace

bool Run::search_by_chains() {
  if (effort_.kicks_per_cluster == 0.0 || instance_.is_sparse()) return false;
  const search::Problem problem(instance_, anchor_, all_alive(instance_, anchor_));
  if (problem.cluster_count() < search::kLeastClusters || problem.has_missing()) return false;
  search::ChainSetup setup;
  setup.seed = options_.seed;
  setup.threads = options_.threads;
  setup.stop = options_.stop;
  const double m = problem.cluster_count();
  setup.enough_hits = effort_.enough_hits;
  const double natural = effort_.kicks_per_cluster * m / (options_.warm_tour ? kWarmShare : 1.0);
  setup.kicks = std::min(
      {static_cast<std::uint64_t>(natural), options_.stop.max_iterations, options_.stop.max_evaluations});
  setup.stop.max_iterations = std::numeric_limits<std::uint64_t>::max();
  setup.stop.max_evaluations = std::numeric_limits<std::uint64_t>::max();
  outcomes_.resize(search::kChains);
  const auto original = [&](int v) { return problem.original(v); };
  if (options_.warm_tour) {
    const search::WarmTour warm = search::usable_part(problem, *options_.warm_tour);
    if (warm.is_whole) consider(found_from(instance_, anchor_, warm.tour, original, options_.kind), 0, 0);
    if (!warm.tour.empty()) setup.start = search::completed(problem, warm.tour);
  }
  const std::uint64_t kicks = search::run_chains(
      problem, setup, [&](int chain, const std::vector<int>& tour, std::uint64_t iteration) {
        consider(found_from(instance_, anchor_, tour, original, options_.kind), iteration, chain);
      });
  outcomes_.front().iterations = kicks;
  const bool is_bounded =
      !reduced_ && instance_.vertex_count() <= kMaxBoundVertices && !options_.stop.reached(0, 0);
  if (is_bounded) finish_unreachable();
  conclude();
  return true;
}

}  // namespace swallowtail::gtsp::detail
