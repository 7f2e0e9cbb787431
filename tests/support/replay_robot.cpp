#include "tests/support/replay_robot.hpp"

#include <algorithm>
#include <cmath>

#include "tests/support/cover_oracle.hpp"

namespace swallowtail::test_support {
namespace {

constexpr int kChargingSteps = 20'000;
constexpr double kStep_m = 0.5;
constexpr double kOnRoad_m = 0.02;
constexpr double kOverRoad_m = 2.01;  ///< from a place to a road that it is said to be on

double flat(const Vec3& a, const Vec3& b) { return std::hypot(a.x() - b.x(), a.y() - b.y()); }

/// Steps along a piece, both ends included.
template <class Look>
bool all_along(const Vec3& from, const Vec3& to, const Look& look) {
  const int steps = std::max(1, static_cast<int>(std::ceil(flat(from, to) / kStep_m)));
  for (int i = 0; i <= steps; ++i) {
    if (!look(Vec3(from + (to - from) * (static_cast<double>(i) / steps)))) return false;
  }
  return true;
}

double distance_to_roads(const std::vector<std::vector<Vec2>>& roads, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& road : roads) {
    for (std::size_t i = 0; i + 1 < road.size(); ++i) {
      const Vec2 way = road[i + 1] - road[i];
      const Vec2 to = Vec2(p.x(), p.y()) - road[i];
      const double t = std::clamp(to.dot(way) / std::max(1e-12, way.squaredNorm()), 0.0, 1.0);
      least = std::min(least, (to - t * way).norm());
    }
  }
  return least;
}

double slope_at(const GroundAt& ground, const Vec3& p) {
  constexpr double kHalf_m = 0.05;
  const double dx = ground(p.x() + kHalf_m, p.y()) - ground(p.x() - kHalf_m, p.y());
  const double dy = ground(p.x(), p.y() + kHalf_m) - ground(p.x(), p.y() - kHalf_m);
  return std::atan(std::hypot(dx, dy) / (2.0 * kHalf_m));
}

bool is_forbidden(const coverage::Polygon& polygon, const Vec3& p) {
  Ground ground;
  const auto add = [&](const coverage::Ring& ring) {
    std::vector<Point> points;
    for (const Vec2& q : ring) points.emplace_back(q.x(), q.y());
    ground.rings.push_back(std::move(points));
  };
  add(polygon.outline);
  for (const coverage::Ring& hole : polygon.holes) add(hole);
  return is_on(ground, {p.x(), p.y()});
}

}  // namespace

double charging_s(const coverage::Task& task, double from, double to) {
  const auto& battery = task.battery;
  if (to <= from) return 0.0;
  const double begin = battery.taper_from * battery.capacity;
  double time = 0.0;
  const double step = (to - from) / kChargingSteps;
  for (int i = 0; i < kChargingSteps; ++i) {
    const double held = from + (i + 0.5) * step;
    double share = 1.0;
    if (held > begin && battery.taper_from < 1.0) {
      const double past = std::min(1.0, (held - begin) / (battery.capacity - begin));
      share = 1.0 + past * (battery.taper_end_rate - 1.0);
    }
    time += step * battery.charge_s_per_unit / share;
  }
  return time;
}

double ReplayRobot::piece_s(const Vec3& to_m, std::vector<std::string>& faults) const {
  const double length = flat(at_m_, to_m);
  if (length < 1e-9) return 0.0;
  const bool open = all_along(at_m_, to_m, [&](const Vec3& p) {
    if (slope_at(ground_, p) > roads_.slope_max_rad + 1e-3) return false;
    return std::none_of(roads_.forbidden.begin(), roads_.forbidden.end(),
                        [&](const auto& polygon) { return is_forbidden(polygon, p); });
  });
  if (!open) faults.push_back("the robot drives over ground that is too steep or forbidden");
  if (roads_.roads.empty()) return length / task_.charger.speed_mps;
  const auto is_near = [&](double within_m) {
    return all_along(at_m_, to_m,
                     [&](const Vec3& p) { return distance_to_roads(roads_.roads, p) <= within_m; });
  };
  if (is_near(kOnRoad_m)) return length / roads_.road_speed_mps;
  if (roads_.off_road_speed_mps > 0.0) return length / roads_.off_road_speed_mps;
  if (!is_near(kOverRoad_m)) faults.push_back("the robot leaves the road");
  return length / roads_.road_speed_mps;
}

double ReplayRobot::drive_to(const std::vector<Vec3>& bends_m, const Vec3& place_m,
                             std::vector<std::string>& faults) {
  double time = 0.0;
  last_.clear();
  const auto drive = [&](const Vec3& to_m) {
    last_.push_back({at_m_, to_m, piece_s(to_m, faults)});
    time += last_.back().time_s;
    at_m_ = to_m;
  };
  for (const Vec3& bend : bends_m) drive(bend);
  drive(place_m);
  held -= time * task_.charger.battery.drive_per_s;
  return time;
}

void ReplayRobot::tell(const DriveWatch& watch, double arrives_s) const {
  if (!watch) return;
  double time_s = arrives_s;
  for (const Piece& piece : last_) time_s -= piece.time_s;
  for (const Piece& piece : last_) {
    watch(time_s, piece.from_m, time_s + piece.time_s, piece.to_m);
    time_s += piece.time_s;
  }
}

}  // namespace swallowtail::test_support
