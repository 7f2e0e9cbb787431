#pragma once

#include <limits>

namespace swallowtail {

/// True once per period of wall time, on average to the period even when asked at odd times; calls that were
/// missed are not made up for.
class Due {
 public:
  explicit Due(double period_s) : period_s_(period_s) {}

  bool operator()(double wall_s) {
    if (wall_s < next_s_) return false;
    next_s_ = next_s_ + period_s_ > wall_s ? next_s_ + period_s_ : wall_s + period_s_;
    return true;
  }
  /// Something else has just done what this would have asked for.
  void put_off(double wall_s) { next_s_ = wall_s + period_s_; }

 private:
  double period_s_;
  double next_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace swallowtail
