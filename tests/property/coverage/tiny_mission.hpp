#pragma once

#include <deque>
#include <string>
#include <vector>

#include "coverage/maintain/plan_keeper.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::coverage::test {

struct MissionWeather {
  double bias = 1.0;        ///< consumption against prediction
  double noise = 0.05;      ///< besides, anew each second
  double loss_at_s = -1.0;  ///< energy gone at once, aloft
  double loss = 0.0;
  double skip_from_s = -1.0;      ///< the aircraft swerves off its line for 4 s
  double force_landing_s = -1.0;  ///< lands where it is
};

struct MissionLog {
  bool completed = false;
  double time_s = 0.0;
  double energy_min = 1e300;
  double energy_max = 0.0;
  int revisions = 0;
  double cover_flight_m = 0.0;
  std::vector<Vec3> covered;  ///< positions on a cover leg's line, a metre apart or less
  std::vector<std::string> reasons;
  std::vector<std::string> faults;  ///< e.g. a prefix that changed
};

/// A mission in a few lines: flies and drives exactly what PlanKeeper's plan says and tells it what happens.
/// Flat ground at 0, the document's energy model.
MissionLog fly(PlanKeeper& keeper, const MissionWeather& weather, std::uint64_t seed, double most_s);

}  // namespace swallowtail::coverage::test
