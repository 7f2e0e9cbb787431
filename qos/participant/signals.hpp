#pragma once

#include <atomic>

namespace swallowtail {

/// Turns SIGINT and SIGTERM into a flag and a wake-up while it lives; SIGPIPE is ignored. The second signal
/// ends the process at once (exit 130). One per process at a time; make it before any thread starts, so that
/// system calls of those threads are restarted, not failed.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  bool requested() const { return flag().load(std::memory_order_relaxed); }
  /// For a StopCondition.
  const std::atomic<bool>& flag() const;
  /// As if a first signal had come.
  void request();
  /// Sleeps until the time has passed or a stop is requested; returns `requested()`.
  bool wait_for(double seconds) const;
};

}  // namespace swallowtail
