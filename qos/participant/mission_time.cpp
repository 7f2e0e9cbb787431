#include "qos/participant/mission_time.hpp"

#include <algorithm>

namespace swallowtail {

void MissionTime::update(const data::MissionClock& clock, double wall_now_s) {
  const std::lock_guard lock(mutex_);
  if (clock.time_s < told_s_ - kRestart_s * std::max(1.0, clock.rate)) told_s_ = clock.time_s;
  last_ = clock;
  received_s_ = wall_now_s;
}

double MissionTime::estimate_s(double wall_now_s) const {
  if (!last_) return 0.0;
  if (last_->state != data::ClockState::kRunning) return last_->time_s;
  return last_->time_s + last_->rate * std::clamp(wall_now_s - received_s_, 0.0, kCoast_s);
}

double MissionTime::now_s(double wall_now_s) const {
  const std::lock_guard lock(mutex_);
  told_s_ = std::max(told_s_, estimate_s(wall_now_s));
  return told_s_;
}

double MissionTime::rate() const {
  const std::lock_guard lock(mutex_);
  return last_ ? last_->rate : 1.0;
}

data::ClockState MissionTime::state() const {
  const std::lock_guard lock(mutex_);
  return last_ ? last_->state : data::ClockState::kWaiting;
}

}  // namespace swallowtail
