#pragma once

#include <algorithm>
#include <utility>

#include "planner/base/clock.hpp"
#include "qos/participant/signals.hpp"

namespace swallowtail {

/// Calls `step()` every `period_s` of wall time until it returns false or a stop is requested. A step that
/// overruns is followed by the next one at once; missed calls are not made up for.
template <class Step>
void run_loop(const StopSignals& stop, double period_s, Step&& step) {
  const SteadyClock clock;
  double due_s = clock.now_s();
  while (!stop.requested() && std::forward<Step>(step)()) {
    due_s = std::max(due_s + period_s, clock.now_s());
    if (stop.wait_for(due_s - clock.now_s())) return;
  }
}

}  // namespace swallowtail
