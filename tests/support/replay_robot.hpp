#pragma once

#include "coverage/schedule/plan.hpp"

namespace swallowtail::test_support {

/// Seconds from one energy to a higher one, from the task's battery, summed in small steps.
double charging_s(const coverage::Task& task, double from, double to);

/// Where the ground robot is, and when it may leave.
class ReplayRobot {
 public:
  explicit ReplayRobot(const coverage::Task& task) : task_(task), at_m_(task.charger.start_m) {}

  /// Drives to a place as fast as it can; tells how long it takes.
  double drive_to(const Vec3& place_m);

  double free_s = 0.0;

 private:
  const coverage::Task& task_;
  Vec3 at_m_;
};

}  // namespace swallowtail::test_support
