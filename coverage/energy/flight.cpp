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

FlightCost FlightModel::level(double length_m) const {
  const double time = length_m / limits_.cruise_speed_mps;
  return {time, time * energy_.level_per_s, length_m};
}

FlightCost FlightModel::vertical(double height_m) const {
  const bool climbs = height_m > 0.0;
  const double time = std::abs(height_m) / (climbs ? limits_.climb_speed_mps : limits_.descent_speed_mps);
  return {time, time * (climbs ? energy_.climb_per_s : energy_.descent_per_s), std::abs(height_m)};
}

FlightCost FlightModel::stop() const {
  return {planner::kStopToTurn_s, planner::kStopToTurn_s * energy_.hover_per_s, 0.0};
}

Vec3 FlightModel::ground(const Vec3& at) const {
  return {at.x(), at.y(), terrain_->height_at(at.x(), at.y())};
}

FlightCost FlightModel::take_off(const Vec3& at) const { return vertical(at.z() - ground(at).z()) + stop(); }

FlightCost FlightModel::landing(const Vec3& at) const {
  return stop() + vertical(std::min(0.0, ground(at).z() - at.z()));
}

std::vector<Vec3> FlightModel::way(const Vec3& from, const Vec3& to) const {
  std::vector<Vec3> out{flat(from)};
  if (ways_ != nullptr) {
    for (const Vec2& corner : ways_->corners(from.head<2>(), to.head<2>()))
      out.emplace_back(corner.x(), corner.y(), 0.0);
  }
  out.push_back(flat(to));
  double altitude = std::max(from.z(), to.z());
  if (terrain_->is_flat()) {
    altitude = std::max(altitude, terrain_->flat_elevation_m());
  } else {
    double top = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < out.size(); ++i)
      top = std::max(top, -terrain_->min_height_above(out[i], out[i + 1]));
    const double needed = top + limits_.clearance_m() + kTransferMargin_m;
    if (needed > altitude + kSamePlace_m) altitude = needed;
  }
  for (Vec3& p : out) p.z() = altitude;
  return out;
}

FlightCost FlightModel::turn(const Vec3& before, const Vec3& after) const {
  const double angle = std::atan2(before.cross(after).norm(), before.dot(after));
  return angle > limits_.turn_max_rad + 1e-9 ? stop() : FlightCost{};
}

FlightCost FlightModel::level_part(const std::vector<Vec3>& way, const Ends& ends) const {
  std::optional<Vec3> before = ends.before;
  FlightCost cost;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const Vec3 along = way[i + 1] - way[i];
    const double length = along.norm();
    if (length < kSamePlace_m) continue;
    cost += level(length);
    if (before) cost += turn(*before, along);
    before = along;
  }
  if (before && ends.after) cost += turn(*before, *ends.after);
  return cost;
}

FlightCost FlightModel::transfer(const Vec3& from, const Vec3& to, const Ends& ends) const {
  const std::vector<Vec3> way_there = way(from, to);
  const double altitude = way_there.front().z();
  Ends level_ends = ends;
  FlightCost cost;
  const bool climbs = differs(altitude, from.z());
  const bool descends = differs(altitude, to.z());
  if (climbs) {
    cost += (ends.before ? stop() : FlightCost{}) + vertical(altitude - from.z()) + stop();
    level_ends.before.reset();
  }
  if (descends) {
    cost += stop() + vertical(to.z() - altitude) + (ends.after ? stop() : FlightCost{});
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
