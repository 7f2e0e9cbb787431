#pragma once

#include <algorithm>
#include <optional>

#include "planner/base/checks.hpp"

namespace swallowtail::charger {

/// The robot's own battery: full at the start and whenever it leaves its depot.
struct BatteryLimits {
  double capacity = 0.0;  ///< units
  double reserve = 0.0;   ///< that it keeps
  double drive_per_s = 0.0;
  double per_charged = 1.0;  ///< for each unit that the vehicle is charged with
  double refill_s = 0.0;
};

inline bool is_sound(const BatteryLimits& limits) {
  return is_positive(limits.capacity) && is_non_negative(limits.reserve) &&
         limits.reserve < limits.capacity && is_non_negative(limits.drive_per_s) &&
         is_non_negative(limits.per_charged) && is_non_negative(limits.refill_s);
}

/// What it holds. Without limits its energy has no end, and nothing here changes anything.
class OwnBattery {
 public:
  /// The first limits find it full.
  void limit(const std::optional<BatteryLimits>& limits) {
    const bool is_first = limits && !limits_;
    limits_ = limits;
    if (limits_) energy_ = is_first ? limits_->capacity : std::min(energy_, limits_->capacity);
  }

  bool is_limited() const { return limits_.has_value(); }
  double energy() const { return is_limited() ? energy_ : 0.0; }
  bool is_empty() const { return is_limited() && energy_ <= 0.0; }
  bool is_full() const { return !is_limited() || energy_ >= limits_->capacity; }
  double capacity() const { return limits_ ? limits_->capacity : 0.0; }
  /// All that it may be asked for when full.
  double usable() const { return limits_ ? limits_->capacity - limits_->reserve : 0.0; }
  double refill_s() const { return limits_ ? limits_->refill_s : 0.0; }
  /// Above its reserve. Only with limits, as the next two.
  double to_spare() const { return energy_ - limits_->reserve; }
  double for_driving(double time_s) const { return limits_->drive_per_s * time_s; }
  double for_charging(double energy) const { return limits_->per_charged * energy; }

  void drive(double time_s) { lose(limits_ ? for_driving(time_s) : 0.0); }
  void give(double energy) { lose(limits_ ? for_charging(energy) : 0.0); }
  void lose(double energy) { energy_ = std::max(0.0, energy_ - energy); }
  void refill() { energy_ = capacity(); }

 private:
  std::optional<BatteryLimits> limits_;
  double energy_ = 0.0;
};

}  // namespace swallowtail::charger
