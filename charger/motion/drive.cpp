#include "charger/motion/drive.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "planner/base/checks.hpp"

namespace swallowtail::charger {
namespace {

constexpr double kSamePlace_m = 1e-6;

Vec3 nearest_on(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec2 way = (b - a).head<2>();
  const double length2 = way.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((p - a).head<2>().dot(way) / length2, 0.0, 1.0) : 0.0;
  return a + share * (b - a);
}

/// Where to go next: back to the way, or to the end of its hop that is under way.
std::size_t hop_under_way(const std::vector<Vec3>& places, const Vec3& position_m) {
  std::size_t found = 1;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double away_m = (nearest_on(places[i - 1], places[i], position_m) - position_m).head<2>().norm();
    if (away_m > nearest_m + kSamePlace_m) continue;
    nearest_m = std::min(nearest_m, away_m);
    found = i;
  }
  return found;
}

}  // namespace

double Drive::distance_to_m(const Vec3& target_m) const {
  return (target_m.head<2>() - position_m_.head<2>()).norm();
}

void Drive::advance(const Vec3& target_m, double speed_mps, double duration_s) {
  speed_mps_ = 0.0;
  if (!is_finite(target_m) || !is_positive(speed_mps) || !is_positive(duration_s)) return;
  const double distance_m = distance_to_m(target_m);
  const double driven_m = std::min(distance_m, speed_mps * duration_s);
  if (driven_m >= distance_m) {
    position_m_ = target_m;
  } else {
    position_m_ += (target_m - position_m_) * (driven_m / distance_m);
  }
  speed_mps_ = driven_m / duration_s;
}

/// The target last.
std::vector<Vec3> Drive::places_ahead(const std::vector<Vec3>& bends_m, const Vec3& target_m) const {
  if (bends_m.empty()) return {target_m};
  std::vector<Vec3> places = bends_m;
  places.push_back(target_m);
  const std::size_t hop = hop_under_way(places, position_m_);
  const Vec3 join = nearest_on(places[hop - 1], places[hop], position_m_);
  std::vector<Vec3> ahead;
  if (distance_to_m(join) > kOnWay_m) ahead.push_back(join);
  ahead.insert(ahead.end(), places.begin() + static_cast<std::ptrdiff_t>(hop), places.end());
  return ahead;
}

double Drive::left_m(const std::vector<Vec3>& bends_m, const Vec3& target_m) const {
  double out = 0.0;
  Vec3 last = position_m_;
  for (const Vec3& place : places_ahead(bends_m, target_m)) {
    out += (place - last).head<2>().norm();
    last = place;
  }
  return out;
}

void Drive::follow(const std::vector<Vec3>& bends_m, const Vec3& target_m, double speed_mps,
                   double duration_s) {
  if (bends_m.empty()) return advance(target_m, speed_mps, duration_s);
  const bool is_sound = is_finite(target_m) && std::all_of(bends_m.begin(), bends_m.end(),
                                                           [](const Vec3& p) { return is_finite(p); });
  speed_mps_ = 0.0;
  if (!is_sound || !is_positive(speed_mps) || !is_positive(duration_s)) return;
  const std::vector<Vec3> ahead = places_ahead(bends_m, target_m);
  double left_m = speed_mps * duration_s;
  for (const Vec3& place : ahead) {
    const double distance_m = distance_to_m(place);
    advance(place, speed_mps, left_m / speed_mps);
    left_m -= distance_m;
    if (left_m <= 0.0) break;
  }
  speed_mps_ = speed_mps - std::max(0.0, left_m) / duration_s;
}

}  // namespace swallowtail::charger
