#include "tests/support/replay_flight.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::test_support {
namespace {

constexpr double kStop_s = 1.0;
constexpr double kSame_m = 1e-6;
constexpr double kSampleEvery_m = 0.25;
constexpr double kAboveClearance_m = 1.0;

double flat_length(const Vec3& v) { return std::hypot(v.x(), v.y()); }

}  // namespace

double power_of(const coverage::Task& task, const Vec3& velocity_mps, double /*altitude_m*/) {
  const auto& rates = task.battery.model;
  if (velocity_mps.norm() < 1e-9) return rates.hover_per_s;
  if (flat_length(velocity_mps) > 1e-9) return rates.level_per_s;
  return velocity_mps.z() > 0.0 ? rates.climb_per_s : rates.descent_per_s;
}

ReplayFlight::ReplayFlight(const coverage::Task& task, double step_s) : task_(task), step_s_(step_s) {}

void ReplayFlight::stand_at(const Vec3& site_m, double at_s, double holds) {
  at_m = site_m;
  time_s = at_s;
  energy = holds;
  before_.reset();
}

void ReplayFlight::spend(double duration_s, const Vec3& velocity_mps) {
  const int steps = std::max(1, static_cast<int>(std::ceil(duration_s / step_s_)));
  const double step = duration_s / steps;
  for (int i = 0; i < steps; ++i) {
    const double altitude = at_m.z() + velocity_mps.z() * step / 2.0;
    energy -= power_of(task_, velocity_mps, altitude) * step;
    at_m += velocity_mps * step;
    least_energy = std::min(least_energy, energy);
  }
  time_s += duration_s;
  flown_s += duration_s;
}

void ReplayFlight::hover() { spend(kStop_s, Vec3::Zero()); }

void ReplayFlight::fly_to(const Vec3& place_m) {
  const Vec3 way = place_m - at_m;
  if (way.norm() < kSame_m) return;
  const bool level = flat_length(way) > kSame_m;
  if (before_) {
    const bool was_level = flat_length(*before_) > kSame_m;
    const double cosine = std::clamp(before_->dot(way) / (before_->norm() * way.norm()), -1.0, 1.0);
    const bool turns = std::acos(cosine) > task_.vehicle.turn_max_rad + 1e-7;
    if (level != was_level || turns) hover();
  }
  const auto& limits = task_.vehicle;
  const double speed = level           ? limits.cruise_speed_mps
                       : way.z() > 0.0 ? limits.climb_speed_mps
                                       : limits.descent_speed_mps;
  spend(way.norm() / speed, way.normalized() * speed);
  flown_m += way.norm();
  at_m = place_m;
  before_ = way;
}

void ReplayFlight::land(double ground_m) {
  fly_to({at_m.x(), at_m.y(), ground_m});
  before_.reset();
}

double altitude_over(const std::vector<Vec3>& way, double ends_m, const coverage::Task& task,
                     const GroundAt& ground) {
  double top = -1e300;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const Vec3 piece = way[i + 1] - way[i];
    const int steps = std::max(1, static_cast<int>(std::ceil(flat_length(piece) / kSampleEvery_m)));
    for (int s = 0; s <= steps; ++s) {
      const Vec3 p = way[i] + piece * (static_cast<double>(s) / steps);
      top = std::max(top, ground(p.x(), p.y()));
    }
  }
  const double needs = top + task.vehicle.radius_m + task.vehicle.margin_m + kAboveClearance_m;
  return std::max(ends_m, needs);
}

}  // namespace swallowtail::test_support
