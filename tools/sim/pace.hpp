#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace swallowtail::sim {

/// How many fixed steps of mission time are owed to the wall clock. A simulation that cannot keep up slips
/// rather than hurrying after: it never owes more than kMostBehind_s of wall time.
class Pace {
 public:
  static constexpr double kMostBehind_s = 0.25;

  Pace(double rate, double step_s) : rate_(rate), step_s_(step_s) {}

  void start(double wall_s) { due_wall_s_ = wall_s; }

  std::uint64_t owed(double wall_s) {
    const double behind_s = wall_s - due_wall_s_;
    if (behind_s > kMostBehind_s) {
      slipped_s_ += (behind_s - kMostBehind_s) * rate_;
      due_wall_s_ = wall_s - kMostBehind_s;
    }
    const double steps = std::max(0.0, (wall_s - due_wall_s_) * rate_ / step_s_ + 1e-9);
    const auto whole = static_cast<std::uint64_t>(steps);
    due_wall_s_ += static_cast<double>(whole) * step_s_ / rate_;
    return whole;
  }

  double slipped_s() const { return slipped_s_; }

 private:
  double rate_;
  double step_s_;
  double due_wall_s_ = 0.0;
  double slipped_s_ = 0.0;
};

/// Keeps a rate of wall time on average, with short bursts.
class Throttle {
 public:
  static constexpr double kBurst_s = 0.05;

  explicit Throttle(double period_s) : period_s_(period_s) {}

  bool allows(double wall_s) {
    if (next_s_ > wall_s) return false;
    next_s_ = std::max(next_s_ + period_s_, wall_s - kBurst_s);
    return true;
  }

 private:
  double period_s_;
  double next_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace swallowtail::sim
