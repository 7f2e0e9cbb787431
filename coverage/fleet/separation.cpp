#include "coverage/fleet/separation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swallowtail::coverage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Times meet(const Times& a, const Times& b) {
  return {std::max(a.from_s, b.from_s), std::min(a.to_s, b.to_s)};
}

/// When |offset + velocity · t| is below a distance.
Times near_times(const Vec2& offset, const Vec2& velocity, double distance) {
  const double a = velocity.squaredNorm();
  const double b = offset.dot(velocity);
  const double c = offset.squaredNorm() - distance * distance;
  if (a < 1e-12) return c < 0.0 ? Times{} : Times{kInfinity, -kInfinity};
  const double root = b * b - a * c;
  if (root <= 0.0) return {kInfinity, -kInfinity};
  return {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a};
}

Vec3 velocity_of(const TimedPiece& piece) {
  const double duration = piece.end_s - piece.start_s;
  if (!std::isfinite(duration) || duration < 1e-12) return Vec3::Zero();
  return (piece.to_m - piece.from_m) / duration;
}

double level_m(const TimedPiece& a, const TimedPiece& b, const Separation& separation) {
  return a.is_landed || b.is_landed ? separation.landed_m : separation.horizontal_m;
}

/// On the ground nobody is above another.
double upright_m(const TimedPiece& a, const TimedPiece& b, const Separation& separation) {
  return a.is_landed && b.is_landed ? kInfinity : separation.vertical_m;
}

}  // namespace

bool boxes_meet(const TimedPiece& a, const TimedPiece& b, const Separation& separation) {
  const double apart_m = level_m(a, b, separation);
  const Vec3 reach(apart_m, apart_m, upright_m(a, b, separation));
  return ((a.from_m.cwiseMax(a.to_m) + reach - b.from_m.cwiseMin(b.to_m)).array() > 0.0).all() &&
         ((b.from_m.cwiseMax(b.to_m) + reach - a.from_m.cwiseMin(a.to_m)).array() > 0.0).all();
}

Times close_times(const TimedPiece& a, double shift_s, const TimedPiece& b, const Separation& separation) {
  const Times both = meet({a.start_s + shift_s, a.end_s + shift_s}, {b.start_s, b.end_s});
  if (!both.last()) return both;
  const Vec3 velocity_a = velocity_of(a);
  const Vec3 velocity_b = velocity_of(b);
  // Times from `both.from_s` on.
  const Vec3 offset = a.from_m + velocity_a * (both.from_s - a.start_s - shift_s) - b.from_m -
                      velocity_b * (both.from_s - b.start_s);
  const Vec3 velocity = velocity_a - velocity_b;
  const Times level = near_times(offset.head<2>(), velocity.head<2>(), level_m(a, b, separation));
  const double least_m = upright_m(a, b, separation);
  const Times upright =
      std::isinf(least_m) ? Times{} : near_times(Vec2(offset.z(), 0.0), Vec2(velocity.z(), 0.0), least_m);
  const Times close = meet(meet(level, upright), {0.0, both.to_s - both.from_s});
  return {close.from_s + both.from_s, close.to_s + both.from_s};
}

bool conflict(const TimedPiece& a, double shift_s, const TimedPiece& b, const Separation& separation) {
  return close_times(a, shift_s, b, separation).last();
}

bool conflict(const Trace& a, const Trace& b, const Separation& separation) {
  const std::vector<TimedPiece> of_b = pieces_of(b);
  for (const TimedPiece& one : pieces_of(a)) {
    for (const TimedPiece& other : of_b) {
      if (boxes_meet(one, other, separation) && conflict(one, 0.0, other, separation)) return true;
    }
  }
  return false;
}

}  // namespace swallowtail::coverage
