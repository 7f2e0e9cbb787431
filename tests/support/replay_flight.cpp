#include "tests/support/replay_flight.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swallowtail::test_support {
namespace {

constexpr double kStop_s = 1.0;
constexpr double kSame_m = 1e-6;
constexpr double kSampleEvery_m = 0.25;
constexpr double kSampleLeast_m = 2e-3;
constexpr double kSteepest = 20.0;  ///< rise over run of any ground
constexpr double kAboveClearance_m = 1.0;

double flat_length(const Vec3& v) { return std::hypot(v.x(), v.y()); }

/// Power balance of an actuator disc: the thrust that holds weight and drag, times the speed of the air
/// through the disc, is what the discs put into the air; blades and electronics take theirs besides.
double multirotor_power(const coverage::EnergyModel& model, const Vec3& velocity_mps) {
  const coverage::Multirotor& craft = *model.multirotor;
  const double rho = craft.air_density_kgpm3;
  const double wx = velocity_mps.x() - model.wind_mps.x();
  const double wy = velocity_mps.y() - model.wind_mps.y();
  const double level = std::hypot(wx, wy);
  const double up = velocity_mps.z() > 0.0 ? velocity_mps.z() : 0.0;
  const double air = std::hypot(level, up);
  const double weight = 9.80665 * (craft.mass_kg + craft.payload_kg);
  const double drag = rho / 2.0 * craft.drag_area_m2 * air * air;
  const double drag_level = air > 0.0 ? drag * level / air : 0.0;
  const double drag_down = air > 0.0 ? drag * up / air : 0.0;
  const double thrust = std::hypot(weight + drag_down, drag_level);
  // The discs lean into the wind: speed of the air along their axis, and across it.
  const double axis = (level * drag_level + up * (weight + drag_down)) / thrust;
  const double across = (level * (weight + drag_down) - up * drag_level) / thrust;
  const double area = craft.rotors * 3.14159265358979323846 * craft.rotor_radius_m * craft.rotor_radius_m;
  double low = 0.0;
  double high = 200.0;
  for (int i = 0; i < 200; ++i) {
    const double v = (low + high) / 2.0;
    const bool enough = 2.0 * rho * area * v * std::hypot(across, axis + v) >= thrust;
    (enough ? high : low) = v;
  }
  const double tip = craft.tip_speed_mps;
  const double blades =
      rho * area * craft.solidity * craft.blade_drag / 8.0 * (tip * tip * tip + 4.65 * tip * across * across);
  const double shaft = thrust * (axis + craft.induced_factor * high) + blades;
  return (shaft / craft.efficiency + craft.avionics_w) / model.unit_j;
}

double low_power(const coverage::EnergyModel& model, const Vec3& velocity_mps) {
  if (model.multirotor) return multirotor_power(model, velocity_mps);
  if (velocity_mps.norm() < 1e-9) return model.hover_per_s;
  if (flat_length(velocity_mps) > 1e-9) return model.level_per_s;
  return velocity_mps.z() > 0.0 ? model.climb_per_s : model.descent_per_s;
}

double thin_air(const coverage::EnergyModel& model, double altitude_m) {
  return 1.0 + model.altitude_per_m * std::max(0.0, altitude_m - model.altitude_from_m);
}

}  // namespace

double power_of(const coverage::Task& task, const Vec3& velocity_mps, double altitude_m) {
  return low_power(task.battery.model, velocity_mps) * thin_air(task.battery.model, altitude_m);
}

ReplayFlight::ReplayFlight(const coverage::Task& task, double step_s) : task_(task), step_s_(step_s) {}

void ReplayFlight::stand_at(const Vec3& site_m, double at_s, double holds) {
  at_m = site_m;
  time_s = at_s;
  energy = holds;
  before_.reset();
  if (watch) watch(time_s, at_m);
}

void ReplayFlight::spend(double duration_s, const Vec3& velocity_mps) {
  const int steps = std::max(1, static_cast<int>(std::ceil(duration_s / step_s_)));
  const double step = duration_s / steps;
  const double low = low_power(task_.battery.model, velocity_mps);
  for (int i = 0; i < steps; ++i) {
    const double altitude = at_m.z() + velocity_mps.z() * step / 2.0;
    energy -= low * thin_air(task_.battery.model, altitude) * step;
    at_m += velocity_mps * step;
    least_energy = std::min(least_energy, energy);
    if (watch) watch(time_s + step * (i + 1), at_m);
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
    const Vec3 ahead = way.normalized();
    const Vec3 behind = before_->normalized();
    // By half the angle: an arc's cosine tells no small ones apart.
    const double angle = 2.0 * std::asin(std::min(1.0, (ahead - behind).norm() / 2.0));
    const bool turns = angle > task_.vehicle.turn_max_rad + 1e-9;
    if (level != was_level || turns) hover();
  }
  const auto& limits = task_.vehicle;
  const double speed = level           ? limits.cruise_speed_mps
                       : way.z() > 0.0 ? limits.climb_speed_mps
                                       : limits.descent_speed_mps;
  // A hair's breadth aside does not make it level flight in what it takes either.
  const Vec3 heading = level ? Vec3(way.normalized()) : Vec3(0.0, 0.0, way.z() > 0.0 ? 1.0 : -1.0);
  spend(way.norm() / speed, heading * speed);
  flown_m += way.norm();
  at_m = place_m;
  before_ = way;
}

void ReplayFlight::land(double ground_m) {
  fly_to({at_m.x(), at_m.y(), ground_m});
  before_.reset();
}

namespace {

/// Raises top to what lies between two samples, looked at ever closer where it might lie higher.
void look_between(const Vec3& from, double from_top, const Vec3& to, double to_top, const GroundAt& ground,
                  double& top) {
  const double length = flat_length(to - from);
  if (length < kSampleLeast_m || std::max(from_top, to_top) + kSteepest * length / 2.0 <= top) return;
  const Vec3 middle = (from + to) / 2.0;
  const double height = ground(middle.x(), middle.y());
  top = std::max(top, height);
  look_between(from, from_top, middle, height, ground, top);
  look_between(middle, height, to, to_top, ground, top);
}

}  // namespace

double altitude_over(const std::vector<Vec3>& way, double ends_m, const coverage::Task& task,
                     const GroundAt& ground) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) length += flat_length(way[i + 1] - way[i]);
  if (length < kSame_m) return ends_m;
  double top = -1e300;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const Vec3 piece = way[i + 1] - way[i];
    const int steps = std::max(1, static_cast<int>(std::ceil(flat_length(piece) / kSampleEvery_m)));
    std::vector<std::pair<Vec3, double>> samples;
    for (int s = 0; s <= steps; ++s) {
      const Vec3 p = way[i] + piece * (static_cast<double>(s) / steps);
      samples.emplace_back(p, ground(p.x(), p.y()));
      top = std::max(top, samples.back().second);
    }
    for (std::size_t s = 0; s + 1 < samples.size(); ++s)
      look_between(samples[s].first, samples[s].second, samples[s + 1].first, samples[s + 1].second, ground,
                   top);
  }
  const double needs = top + task.vehicle.radius_m + task.vehicle.margin_m + kAboveClearance_m;
  return std::max(ends_m, needs);
}

}  // namespace swallowtail::test_support
