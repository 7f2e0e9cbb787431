#pragma once

#include <atomic>
#include <cstdint>
#include <limits>

#include "planner/base/clock.hpp"

namespace swallowtail {

/// When an anytime computation ends: at a deadline, after so much work, or on request, whichever comes first.
/// Asked between steps only, so that a run stopped by work alone is the same on every machine.
struct StopCondition {
  const Clock* clock = nullptr;                                 ///< needed for deadline_s only
  double deadline_s = std::numeric_limits<double>::infinity();  ///< on `clock`
  std::uint64_t max_evaluations = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t max_iterations = std::numeric_limits<std::uint64_t>::max();
  const std::atomic<bool>* stop_requested = nullptr;

  bool interrupted() const {
    return stop_requested != nullptr && stop_requested->load(std::memory_order_relaxed);
  }
  bool reached(std::uint64_t evaluations, std::uint64_t iterations) const {
    return evaluations >= max_evaluations || iterations >= max_iterations || interrupted() ||
           (clock != nullptr && clock->now_s() >= deadline_s);
  }
};

}  // namespace swallowtail
