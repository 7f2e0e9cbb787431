#pragma once

#include <mutex>
#include <optional>

#include "idl/data/types.hpp"

namespace swallowtail {

/// What mission time it is now, from MissionClock samples and this process's own wall clock. Safe to call
/// from any thread. Between samples the time runs on at the clock's rate, for at most kCoast_s of wall time:
/// a clock that falls silent stands still. It does not go back when a sample comes late; a clock that starts
/// anew (more than kRestart_s of wall time behind) is followed.
class MissionTime {
 public:
  static constexpr double kCoast_s = 1.0;
  static constexpr double kRestart_s = 1.0;

  void update(const data::MissionClock& clock, double wall_now_s);

  /// 0 before the first sample.
  double now_s(double wall_now_s) const;

  /// Mission seconds per wall second; 1 before the first sample.
  double rate() const;
  /// kWaiting before the first sample.
  data::ClockState state() const;
  bool running() const { return state() == data::ClockState::kRunning; }
  bool ended() const { return state() == data::ClockState::kEnded; }

 private:
  double estimate_s(double wall_now_s) const;

  mutable std::mutex mutex_;
  std::optional<data::MissionClock> last_;
  double received_s_ = 0.0;
  mutable double told_s_ = 0.0;
};

}  // namespace swallowtail
