#include "coverage/energy/flight.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace swallowtail::coverage {
namespace {

constexpr double kSamePlace_m = 1e-6;
/// Kept above the ground under a transfer, besides the vehicle's clearance.
constexpr double kTransferMargin_m = 1.0;

bool differs(double a, double b) { return std::abs(a - b) > kSamePlace_m; }

Vec3 flat(const Vec3& v) { return {v.x(), v.y(), 0.0}; }

}  // namespace

FlightModel::FlightModel(const planner::VehicleLimits& limits, const EnergyModel& energy,
                         const planner::Terrain& terrain, const Ways* ways)
    : limits_(limits),
      energy_(energy),
      in_wind_((energy.multirotor && energy.wind_mps != Vec2::Zero()) ||
               energy.correction.along != Vec2::Zero()),
      level_per_s_(base_power(energy, Vec3(limits.cruise_speed_mps, 0.0, 0.0))),
      climb_per_s_(base_power(energy, Vec3(0.0, 0.0, limits.climb_speed_mps))),
      descent_per_s_(base_power(energy, Vec3(0.0, 0.0, -limits.descent_speed_mps))),
      hover_per_s_(base_power(energy, Vec3::Zero())),
      terrain_(&terrain),
      ways_(ways) {}

double FlightModel::level_power(const Vec3& along) const {
  if (!in_wind_) return level_per_s_;
  return base_power(energy_, flat(along).normalized() * limits_.cruise_speed_mps);
}

FlightCost FlightModel::level(const Vec3& from, const Vec3& to) const {
  const double length = (to - from).norm();
  const double time = length / limits_.cruise_speed_mps;
  return {time, time * level_power(to - from) * mean_altitude_factor(energy_, from.z(), to.z()), length};
}

FlightCost FlightModel::vertical(double from_m, double to_m) const {
  const bool climbs = to_m > from_m;
  const double height = std::abs(to_m - from_m);
  const double time = height / (climbs ? limits_.climb_speed_mps : limits_.descent_speed_mps);
  const double power = climbs ? climb_per_s_ : descent_per_s_;
  return {time, time * power * mean_altitude_factor(energy_, from_m, to_m), height};
}

FlightCost FlightModel::stop(double altitude_m) const {
  return {planner::kStopToTurn_s,
          planner::kStopToTurn_s * hover_per_s_ * altitude_factor(energy_, altitude_m), 0.0};
}

Vec3 FlightModel::ground(const Vec3& at) const {
  return {at.x(), at.y(), terrain_->height_at(at.x(), at.y())};
}

FlightCost FlightModel::take_off(const Vec3& at) const {
  return vertical(ground(at).z(), at.z()) + stop(at.z());
}

FlightCost FlightModel::landing(const Vec3& at) const {
  return stop(at.z()) + vertical(at.z(), std::min(at.z(), ground(at).z()));
}

bool FlightModel::is_barred(const Vec3& from, const Vec3& to) const {
  return ways_ != nullptr && !ways_->corners(from.head<2>(), to.head<2>());
}

std::vector<Vec3> FlightModel::way(const Vec3& from, const Vec3& to) const {
  std::vector<Vec3> out{flat(from)};
  if (ways_ != nullptr) {
    const auto corners = ways_->corners(from.head<2>(), to.head<2>());
    if (corners) {
      for (const Vec2& corner : *corners) out.emplace_back(corner.x(), corner.y(), 0.0);
    }
  }
  out.push_back(flat(to));
  double altitude = std::max(from.z(), to.z());
  const bool is_upright = out.size() == 2 && (out[1] - out[0]).norm() < kSamePlace_m;
  if (terrain_->is_flat()) {
    altitude = std::max(altitude, terrain_->flat_elevation_m());
  } else if (!is_upright) {
    double top = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < out.size(); ++i)
      top = std::max(top, -terrain_->min_height_above(out[i], out[i + 1]));
    const double needed = top + limits_.clearance_m() + kTransferMargin_m;
    if (needed > altitude + kSamePlace_m) altitude = needed;
  }
  for (Vec3& p : out) p.z() = altitude;
  return out;
}

FlightCost FlightModel::turn(const Vec3& before, const Vec3& after, double altitude_m) const {
  const double angle = std::atan2(before.cross(after).norm(), before.dot(after));
  return angle > limits_.turn_max_rad + 1e-9 ? stop(altitude_m) : FlightCost{};
}

FlightCost FlightModel::level_part(const std::vector<Vec3>& way, const Ends& ends) const {
  std::optional<Vec3> before = ends.before;
  FlightCost cost;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const Vec3 along = way[i + 1] - way[i];
    if (along.norm() < kSamePlace_m) continue;
    cost += level(way[i], way[i + 1]);
    if (before) cost += turn(*before, along, way[i].z());
    before = along;
  }
  if (before && ends.after) cost += turn(*before, *ends.after, way.back().z());
  return cost;
}

FlightCost FlightModel::transfer(const Vec3& from, const Vec3& to, const Ends& ends) const {
  if (is_barred(from, to)) return kBarred;
  const std::vector<Vec3> way_there = way(from, to);
  const double altitude = way_there.front().z();
  Ends level_ends = ends;
  FlightCost cost;
  const bool climbs = differs(altitude, from.z());
  const bool descends = differs(altitude, to.z());
  if (climbs) {
    cost += (ends.before ? stop(from.z()) : FlightCost{}) + vertical(from.z(), altitude) + stop(altitude);
    level_ends.before.reset();
  }
  if (descends) {
    cost += stop(altitude) + vertical(altitude, to.z()) + (ends.after ? stop(to.z()) : FlightCost{});
    level_ends.after.reset();
  }
  return cost + level_part(way_there, level_ends);
}

FlightCost FlightModel::take_off_to(const Vec3& from, const Vec3& to,
                                    const std::optional<Vec3>& after) const {
  Vec3 above = from;
  above.z() = transfer_altitude(Vec3(from.x(), from.y(), to.z()), to);
  return take_off(above) + transfer(above, to, {std::nullopt, after});
}

FlightCost FlightModel::transfer_and_land(const Vec3& from, const std::optional<Vec3>& before,
                                          const Vec3& to) const {
  Vec3 above = to;
  above.z() = transfer_altitude(from, to);
  return transfer(from, above, {before, std::nullopt}) + landing(above);
}

}  // namespace swallowtail::coverage
