#pragma once

#include <string>

#include "planner/base/stop.hpp"
#include "planner/path/certifier.hpp"
#include "planner/path/path.hpp"

namespace swallowtail::planner {

struct ContingencyRequest {
  const ClearanceQuery& query;
  const VehicleLimits& limits;
  const TimedPath& path;   ///< what was to be flown
  double blocked_s = 0.0;  ///< mission time from which it may not be
  double hold_s = 60.0;    ///< how long a hold must be safe to be taken; shorter ones if there is none
};

struct Contingency {
  bool found = false;
  TimedPath path;  ///< certified, the hold included
  Certificate certificate;
  std::string what;  ///< "flies on and holds", "holds here", "moves aside and holds", "lands"
};

/// The next best to a path: fly on as far as it is certified and hold there; else hold at the start; else
/// move aside and hold; else land below. A hold is certified for its whole time, so that nothing known moves
/// into it. Shorter holds only where no place has a longer one. Bounded work, not stopped by a deadline: this
/// is what must be there in time.
Contingency find_contingency(const ContingencyRequest& request);

}  // namespace swallowtail::planner
