#include "coverage/energy/multirotor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kGravity_mps2 = 9.80665;
constexpr int kMostSteps = 30;

double disc_area_m2(const Multirotor& craft) {
  return craft.rotors * std::numbers::pi * craft.rotor_radius_m * craft.rotor_radius_m;
}

double weight_n(const Multirotor& craft) { return (craft.mass_kg + craft.payload_kg) * kGravity_mps2; }

/// Solves v · √(along² + (through + v)²) = hover² for v by Newton's method from above: the left side rises
/// and is convex there, so that it converges without leaving the root's upper side. `through` must not be
/// negative.
double induced_velocity_mps(double hover_mps, double along_mps, double through_mps) {
  double v = hover_mps;
  for (int i = 0; i < kMostSteps; ++i) {
    const double sum = through_mps + v;
    const double speed = std::sqrt(along_mps * along_mps + sum * sum);
    const double excess = v * speed - hover_mps * hover_mps;
    const double slope = speed + v * sum / speed;
    const double step = excess / slope;
    v -= step;
    if (std::abs(step) < 1e-12 * hover_mps) break;
  }
  return v;
}

}  // namespace

Status validate(const Multirotor& craft) {
  const auto refuse = [](const char* what, const char* rule) -> Status {
    return bad_input(std::string("The multirotor's ") + what + " must be " + rule + ".");
  };
  if (!is_positive(craft.mass_kg)) return refuse("mass", "positive");
  if (!is_non_negative(craft.payload_kg)) return refuse("payload", "at least 0");
  if (craft.rotors < 1 || craft.rotors > 64) return refuse("number of rotors", "1 to 64");
  if (!is_positive(craft.rotor_radius_m)) return refuse("rotor radius", "positive");
  if (!is_non_negative(craft.drag_area_m2)) return refuse("drag area", "at least 0");
  if (!is_within(craft.solidity, 0.0, 1.0)) return refuse("solidity", "0 to 1");
  if (!is_within(craft.blade_drag, 0.0, 1.0)) return refuse("blade drag coefficient", "0 to 1");
  if (!is_positive(craft.tip_speed_mps)) return refuse("tip speed", "positive");
  if (!is_within(craft.induced_factor, 1.0, 3.0)) return refuse("induced power factor", "1 to 3");
  if (!is_within(craft.efficiency, 0.05, 1.0)) return refuse("efficiency", "0.05 to 1");
  if (!is_non_negative(craft.avionics_w)) return refuse("avionics' power", "at least 0");
  if (!is_positive(craft.air_density_kgpm3)) return refuse("air density", "positive");
  if (!is_positive(craft.air_speed_max_mps)) return refuse("greatest air speed", "positive");
  return {};
}

double hover_induced_velocity_mps(const Multirotor& craft) {
  return std::sqrt(weight_n(craft) / (2.0 * craft.air_density_kgpm3 * disc_area_m2(craft)));
}

double power_w(const Multirotor& craft, const Vec3& air_velocity_mps) {
  // A descent is flown with the power of the level flight below it.
  const Vec3 v(air_velocity_mps.x(), air_velocity_mps.y(), std::max(0.0, air_velocity_mps.z()));
  const double speed = v.norm();
  const double weight = weight_n(craft);
  const double drag = 0.5 * craft.air_density_kgpm3 * craft.drag_area_m2 * speed * speed;
  const Vec3 thrust = Vec3(0.0, 0.0, weight) + v * (speed > 0.0 ? drag / speed : 0.0);
  const double thrust_n = thrust.norm();
  const double through = v.dot(thrust) / thrust_n;
  const double along = std::sqrt(std::max(0.0, speed * speed - through * through));
  const double area = disc_area_m2(craft);
  const double hover = std::sqrt(thrust_n / (2.0 * craft.air_density_kgpm3 * area));
  const double induced = craft.induced_factor * thrust_n * induced_velocity_mps(hover, along, through);
  const double advance = along / craft.tip_speed_mps;
  const double profile = craft.solidity * craft.blade_drag / 8.0 * craft.air_density_kgpm3 * area *
                         craft.tip_speed_mps * craft.tip_speed_mps * craft.tip_speed_mps *
                         (1.0 + 4.65 * advance * advance);
  const double useful = drag * speed + weight * v.z();
  return (induced + profile + useful) / craft.efficiency + craft.avionics_w;
}

}  // namespace swallowtail::coverage
