#include "tests/support/replay_robot.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::test_support {
namespace {

double flat(const Vec3& a, const Vec3& b) { return std::hypot(a.x() - b.x(), a.y() - b.y()); }

}  // namespace

double charging_s(const coverage::Task& task, double from, double to) {
  return std::max(0.0, to - from) * task.battery.charge_s_per_unit;
}

double ReplayRobot::drive_to(const Vec3& place_m) {
  const double time = flat(at_m_, place_m) / task_.charger.speed_mps;
  at_m_ = place_m;
  return time;
}

}  // namespace swallowtail::test_support
