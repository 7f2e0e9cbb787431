#include "planner/path/certifier.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "planner/base/checks.hpp"
#include "planner/path/detail/terrain_rule.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kTolerance = 1e-6;  ///< relative, on limits
constexpr double kBelowGround_m = 0.05;
constexpr double kReach_m = 50.0;
/// Numbers beyond these would lose the digits that the rules need, and overflow further on.
constexpr double kMaxPlace_m = 1e7;
constexpr double kMaxTime_s = 1e10;

bool exceeds(double value, double limit) { return !(value <= limit * (1.0 + kTolerance)); }

/// One pass over one path. Rules are the methods; each looks at one segment.
class Inspection {
 public:
  Inspection(const TimedPath& path, const ClearanceQuery& query, const VehicleLimits& limits)
      : path_(path), query_(query), world_(query.world()), limits_(limits) {}

  Certificate run() {
    if (!is_well_formed()) return std::move(certificate_);
    certificate_.clearance_min_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < path_.size(); ++i) check_bounds(i);
    if (path_.size() == 1) check_space(0, path_[0]);
    for (std::size_t i = 1; i < path_.size(); ++i) {
      check_space(i, path_[i - 1]);
      check_motion(i);
    }
    auto& violations = certificate_.violations;
    std::stable_sort(violations.begin(), violations.end(),
                     [](const Violation& a, const Violation& b) { return a.time_s < b.time_s; });
    if (violations.size() > kMaxViolations) violations.resize(kMaxViolations);
    certificate_.certified = violations.empty();
    return std::move(certificate_);
  }

 private:
  bool is_well_formed() {
    if (const Status status = validate(limits_); !status) malformed(0, status.error().message);
    if (path_.empty()) malformed(0, "The path has no waypoint.");
    for (std::size_t i = 0; i < path_.size(); ++i) {
      if (!is_within(path_[i].time_s, -kMaxTime_s, kMaxTime_s) ||
          !(path_[i].position_m.cwiseAbs().maxCoeff() <= kMaxPlace_m) || !is_finite(path_[i].position_m)) {
        malformed(i, fmt::format("Waypoint {} is not finite or beyond {:g} m, {:g} s.", i, kMaxPlace_m,
                                 kMaxTime_s));
      } else if (i > 0 && path_[i].time_s < path_[i - 1].time_s) {
        malformed(i, fmt::format("Waypoint {} is at {} s, before the one ahead of it at {} s.", i,
                                 path_[i].time_s, path_[i - 1].time_s));
      }
      if (certificate_.violations.size() >= kMaxViolations) break;
    }
    return certificate_.violations.empty();
  }

  void malformed(std::size_t index, std::string detail) {
    const bool has_time = index < path_.size() && is_finite(path_[index].time_s);
    const bool has_place = index < path_.size() && is_finite(path_[index].position_m);
    certificate_.violations.push_back({ViolationKind::kMalformed, has_time ? path_[index].time_s : 0.0,
                                       has_place ? path_[index].position_m : Vec3::Zero(), 0, index,
                                       std::move(detail)});
  }

  void check_bounds(std::size_t i) {
    const Vec3& p = path_[i].position_m;
    if (world_.bounds().contains(p)) return;
    report(ViolationKind::kBounds, i, path_[i].time_s, p,
           fmt::format("Waypoint {} at ({:.3f}, {:.3f}, {:.3f}) m lies outside the world's bounds.", i, p.x(),
                       p.y(), p.z()));
  }

  /// The segment from `from` to waypoint i, against obstacles and ground.
  void check_space(std::size_t i, const TimedWaypoint& from) {
    check_obstacles(i, from);
    check_terrain(i, from);
  }

  void check_obstacles(std::size_t i, const TimedWaypoint& from) {
    const TimedWaypoint& to = path_[i];
    const double required_m = limits_.clearance_m();
    const Clearance clearance =
        query_.of_flight(from.position_m, from.time_s, to.position_m, to.time_s, required_m + kReach_m);
    certificate_.clearance_min_m = std::min(certificate_.clearance_min_m, clearance.distance_m);
    if (clearance.slack_m >= required_m && clearance.distance_m > 0.0) return;
    report(ViolationKind::kObstacle, i, clearance.time_s, place_at(from, to, clearance.time_s),
           fmt::format("{:.3f} m are left to obstacle {} and its margin; {:.3f} m are required.",
                       clearance.slack_m, clearance.obstacle_id, required_m),
           clearance.obstacle_id);
  }

  void check_terrain(std::size_t i, const TimedWaypoint& from) {
    const TimedWaypoint& to = path_[i];
    const Terrain& terrain = world_.terrain();
    const double height = terrain.min_height_above(from.position_m, to.position_m);
    const bool touches_down = to.phase == Phase::kTakeOff || to.phase == Phase::kLanding;
    if (touches_down && is_vertical(to.position_m - from.position_m)) {
      if (height >= -kBelowGround_m) return;
      const TimedWaypoint& lower = to.position_m.z() < from.position_m.z() ? to : from;
      report(ViolationKind::kTerrain, i, lower.time_s, lower.position_m,
             fmt::format("A vertical segment ends {:.3f} m below ground; at most {} m is allowed.", -height,
                         kBelowGround_m));
      return;
    }
    certificate_.clearance_min_m = std::min(certificate_.clearance_min_m, height);
    const auto fault =
        detail::find_terrain_fault(terrain, from.position_m, to.position_m, limits_.clearance_m());
    if (!fault) return;
    const double time_s = from.time_s + (to.time_s - from.time_s) * fault->fraction;
    report(ViolationKind::kTerrain, i, time_s,
           from.position_m + (to.position_m - from.position_m) * fault->fraction,
           fmt::format("{:.3f} m above ground of slope {:.2f}; {:.3f} m of clearance are required.",
                       fault->height_m, fault->slope, limits_.clearance_m()));
  }

  void check_motion(std::size_t i) {
    const Vec3 move = path_[i].position_m - path_[i - 1].position_m;
    const double duration_s = path_[i].time_s - path_[i - 1].time_s;
    if (move.norm() <= kSamePlace_m) {
      stopped_s_ += duration_s;
      return;
    }
    check_speed(i, move, duration_s);
    check_climb(i, move);
    if (last_move_) check_turn(i, *last_move_, move);
    last_move_ = move;
    stopped_s_ = 0.0;
  }

  void check_speed(std::size_t i, const Vec3& move, double duration_s) {
    if (!(duration_s > 0.0)) {
      fault(ViolationKind::kSpeed, i, fmt::format("{:.6f} m are flown in no time.", move.norm()));
      return;
    }
    const double speed = move.norm() / duration_s;
    if (!is_vertical(move) && exceeds(speed, limits_.cruise_speed_mps)) {
      fault(ViolationKind::kSpeed, i,
            fmt::format("{:.4f} m/s along the path; at most {:.4f} m/s is allowed.", speed,
                        limits_.cruise_speed_mps));
    }
    const double rise = move.z() / duration_s;
    if (exceeds(rise, limits_.climb_speed_mps)) {
      fault(ViolationKind::kSpeed, i,
            fmt::format("{:.4f} m/s up; at most {:.4f} m/s is allowed.", rise, limits_.climb_speed_mps));
    }
    if (exceeds(-rise, limits_.descent_speed_mps)) {
      fault(ViolationKind::kSpeed, i,
            fmt::format("{:.4f} m/s down; at most {:.4f} m/s is allowed.", -rise, limits_.descent_speed_mps));
    }
  }

  void check_climb(std::size_t i, const Vec3& move) {
    if (is_vertical(move)) return;
    const double angle = std::atan2(std::abs(move.z()), move.head<2>().norm());
    if (!exceeds(angle, limits_.climb_max_rad)) return;
    fault(ViolationKind::kClimb, i,
          fmt::format("{:.4f} rad of climb or descent; at most {:.4f} rad is allowed.", angle,
                      limits_.climb_max_rad));
  }

  void check_turn(std::size_t i, const Vec3& before, const Vec3& after) {
    if (!(stopped_s_ < kStopToTurn_s * (1.0 - kTolerance))) return;
    double angle = std::atan2(before.cross(after).norm(), before.dot(after));
    if (is_vertical(before) != is_vertical(after)) angle = std::max(angle, std::numbers::pi / 2.0);
    if (!exceeds(angle, limits_.turn_max_rad)) return;
    fault(ViolationKind::kTurn, i,
          fmt::format("The direction changes by {:.4f} rad after {:.3f} s of stop; at most {:.4f} rad is "
                      "allowed without {} s.",
                      angle, stopped_s_, limits_.turn_max_rad, kStopToTurn_s));
  }

  static bool is_vertical(const Vec3& move) { return move.head<2>().norm() <= kSamePlace_m; }

  static Vec3 place_at(const TimedWaypoint& from, const TimedWaypoint& to, double time_s) {
    const double duration_s = to.time_s - from.time_s;
    const double share = duration_s > 0.0 ? std::clamp((time_s - from.time_s) / duration_s, 0.0, 1.0) : 0.0;
    return from.position_m + (to.position_m - from.position_m) * share;
  }

  /// A violation of the motion on segment i, which begins at its first waypoint.
  void fault(ViolationKind kind, std::size_t i, std::string detail) {
    report(kind, i, path_[i - 1].time_s, path_[i - 1].position_m, std::move(detail));
  }

  void report(ViolationKind kind, std::size_t i, double time_s, const Vec3& where_m, std::string detail,
              std::uint32_t obstacle_id = 0) {
    certificate_.violations.push_back({kind, time_s, where_m, obstacle_id, i, std::move(detail)});
  }

  const TimedPath& path_;
  const ClearanceQuery& query_;
  const World& world_;
  const VehicleLimits& limits_;
  Certificate certificate_;
  std::optional<Vec3> last_move_;
  double stopped_s_ = 0.0;
};

}  // namespace

const char* name(ViolationKind kind) {
  switch (kind) {
    case ViolationKind::kMalformed:
      return "malformed";
    case ViolationKind::kBounds:
      return "bounds";
    case ViolationKind::kTerrain:
      return "terrain";
    case ViolationKind::kObstacle:
      return "obstacle";
    case ViolationKind::kTurn:
      return "turn";
    case ViolationKind::kClimb:
      return "climb";
    case ViolationKind::kSpeed:
      return "speed";
  }
  return "unknown";
}

Certificate certify(const TimedPath& path, const ClearanceQuery& query, const VehicleLimits& limits) {
  return Inspection(path, query, limits).run();
}

}  // namespace swallowtail::planner
