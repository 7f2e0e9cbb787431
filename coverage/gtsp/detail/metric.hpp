#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coverage/gtsp/instance.hpp"

namespace swallowtail::gtsp::detail {

/// Latitude or longitude given as degrees.minutes, in radians, with TSPLIB's own value of pi. Source:
/// [TSPLIB95 §2.4].
inline double geo_radians(double degrees_minutes) {
  constexpr double kTsplibPi = 3.141592;
  const double degrees = std::trunc(degrees_minutes);
  return kTsplibPi * (degrees + 5.0 * (degrees_minutes - degrees) / 3.0) / 180.0;
}

/// The point as distance() wants it: in radians for the metrics on a sphere, else unchanged.
inline Point prepared_point(const Point& p, Metric metric) {
  if (metric == Metric::kGeo) return {geo_radians(p.x), geo_radians(p.y)};
  if (metric == Metric::kGeom) return {p.x * std::numbers::pi / 180.0, p.y * std::numbers::pi / 180.0};
  return p;
}

/// Source: [TSPLIB95 §2.4].
inline double geo_distance(const Point& a, const Point& b) {
  constexpr double kRadiusKm = 6378.388;
  const double q1 = std::cos(a.y - b.y);
  const double q2 = std::cos(a.x - b.x);
  const double q3 = std::cos(a.x + b.x);
  const double cosine = std::clamp(0.5 * ((1.0 + q1) * q2 - (1.0 - q1) * q3), -1.0, 1.0);
  return std::floor(kRadiusKm * std::acos(cosine) + 1.0);
}

/// Great-circle metres, rounded up past the next integer as in Concorde's files of type GEOM.
inline double geom_distance(const Point& a, const Point& b) {
  constexpr double kRadiusM = 6378388.0;
  const double half_sin = std::sin((a.y - b.y) / 2.0);
  const double half_cos = std::cos((a.y - b.y) / 2.0);
  const double q1 = std::cos(b.x) * std::sin(a.y - b.y);
  const double q2 = std::sin(a.x + b.x) * half_sin * half_sin - std::sin(a.x - b.x) * half_cos * half_cos;
  const double q5 = std::cos(a.x - b.x) * half_cos * half_cos - std::cos(a.x + b.x) * half_sin * half_sin;
  return std::floor(kRadiusM * std::atan2(std::hypot(q1, q2), q5) + 1.0);
}

/// Pseudo-Euclidean. Source: [TSPLIB95 §2.5].
inline double att_distance(double dx, double dy) {
  const double exact = std::sqrt((dx * dx + dy * dy) / 10.0);
  const double rounded = std::floor(exact + 0.5);
  return rounded < exact ? rounded + 1.0 : rounded;
}

/// Distance of two prepared points.
inline double distance(const Point& a, const Point& b, Metric metric) {
  const double dx = a.x - b.x;
  const double dy = a.y - b.y;
  switch (metric) {
    case Metric::kEuc2D:
      return std::floor(std::sqrt(dx * dx + dy * dy) + 0.5);
    case Metric::kCeil2D:
      return std::ceil(std::sqrt(dx * dx + dy * dy));
    case Metric::kGeo:
      return geo_distance(a, b);
    case Metric::kGeom:
      return geom_distance(a, b);
    case Metric::kAtt:
      return att_distance(dx, dy);
  }
  return kNoArc;
}

}  // namespace swallowtail::gtsp::detail
