#pragma once

#include <atomic>
#include <cstdint>

namespace swallowtail {

/// Where time comes from. Algorithms get one passed in; nothing reads the system's clock on its own.
class Clock {
 public:
  virtual ~Clock() = default;
  /// Seconds since an arbitrary fixed instant; never goes back.
  virtual double now_s() const = 0;
};

/// The machine's monotonic clock.
class SteadyClock final : public Clock {
 public:
  double now_s() const override;
};

/// CPU time of the calling thread. What a deadline on it ends does not depend on who else uses the machine.
class ThreadCpuClock final : public Clock {
 public:
  double now_s() const override;
};

/// A clock for tests: it stands still until moved.
class ManualClock final : public Clock {
 public:
  double now_s() const override { return now_s_.load(); }
  void advance(double seconds) { now_s_.store(now_s_.load() + seconds); }

 private:
  std::atomic<double> now_s_{0.0};
};

/// CPU seconds this process has used.
double process_cpu_s();

/// Most memory this process has held, MiB.
double process_peak_rss_mb();

}  // namespace swallowtail
