#pragma once

#include <cstdint>
#include <vector>

#include "planner/base/rng.hpp"
#include "planner/replan/corridor_search.hpp"
#include "planner/replan/sidestep.hpp"
#include "planner/replan/taut_string.hpp"

namespace swallowtail::planner {

/// Improves a chain of many points by looking for another way along one stretch of it at a time: what a whole
/// search cannot do among thousands of obstacles, since its few waypoints cannot pass them all. Nothing may
/// move. Borrows everything it is given.
class StretchSearch {
 public:
  StretchSearch(const DetourProblem& problem, const CorridorParams& params, Sidestep& sidestep,
                TautString& taut, Rng& rng);

  /// Looks for another way along a random stretch, by sidesteps in random order; true if the chain got
  /// shorter. What it spent is added to `evaluations`.
  bool try_tree(std::vector<Vec3>& chain, std::uint64_t& evaluations);
  /// The same by a short flight of the swarm between the stretch's ends.
  Result<bool> try_swarm(std::vector<Vec3>& chain, const swarm::AnyParams& params,
                         std::uint64_t& evaluations);

 private:
  struct Stretch {
    std::size_t first = 0;
    std::size_t last = 0;
  };

  Stretch pick(const std::vector<Vec3>& chain);
  /// Pulls way_ taut and puts it in the stretch's place if it is free and shorter.
  bool replace(std::vector<Vec3>& chain, const Stretch& stretch, std::uint64_t& evaluations);

  const DetourProblem& problem_;
  const CorridorParams& params_;
  Sidestep& sidestep_;
  TautString& taut_;
  Rng& rng_;
  double steepest_;
  std::vector<Vec3> way_;
};

}  // namespace swallowtail::planner
