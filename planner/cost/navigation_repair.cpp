#include <algorithm>

#include "planner/cost/navigation_path.hpp"

namespace swallowtail::planner::navigation {
namespace {

constexpr int kPlanPasses = 6;
constexpr int kHeightPasses = 8;

Vec2 level(const Vec3& p) { return p.head<2>(); }

double heading_rad(const Path& path, int segment) {
  const Vec3 d = path.at[segment + 1] - path.at[segment];
  return std::atan2(d.y(), d.x());
}

/// Moves the nodes of a segment so that its point nearest to the axis comes to `distance_m` from it.
bool push_out(Path& path, int j, const Vec2& axis, double distance_m) {
  const Vec2 a = level(path.at[j]);
  const Vec2 d = level(path.at[j + 1]) - a;
  const double squared = d.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((axis - a).dot(d) / squared, 0.0, 1.0) : 0.0;
  const Vec2 away = a + t * d - axis;
  const double found_m = away.norm();
  if (found_m >= distance_m) return false;
  const Vec2 direction = found_m > 1e-9 * distance_m
                             ? Vec2(away / found_m)
                             : Vec2(-d.y(), d.x()) / std::max(d.norm(), 1e-9 * distance_m);
  const double from_a = j == 0 ? 0.0 : 1.0 - t;
  const double from_b = j + 2 == path.points ? 0.0 : t;
  const double gain = from_a * (1.0 - t) + from_b * t;
  if (gain < 1e-3) return false;
  const Vec2 push = (distance_m * (1.0 + 1e-3) - found_m) / gain * direction;
  path.at[j].head<2>() += from_a * push;
  path.at[j + 1].head<2>() += from_b * push;
  return true;
}

/// Seen from above: out of threats, turns within the limit, nodes in the box.
void repair_plan(const Scene& scene, Path& path) {
  const NavigationSpec& spec = scene.spec;
  for (int pass = 0; pass < kPlanPasses; ++pass) {
    bool changed = false;
    for (int j = 0; j < path.segments(); ++j) {
      for (const NavigationSpec::Threat& threat : spec.threats) {
        const double keep_m = spec.vehicle_size_m + threat.radius_m + kGuard_m;
        changed = push_out(path, j, threat.center_m, keep_m) || changed;
      }
    }
    for (int j = 1; j + 1 < path.points; ++j) {
      path.at[j].head<2>() = level(path.at[j]).cwiseMax(spec.box_min_m).cwiseMin(spec.box_max_m);
      const double turn = wrapped(heading_rad(path, j) - heading_rad(path, j - 1));
      if (std::abs(turn) <= spec.turn_max_rad * (1.0 - kGuardShare)) continue;
      const Vec2 middle = 0.5 * (level(path.at[j - 1]) + level(path.at[j + 1]));
      path.at[j].head<2>() += 0.5 * (middle - level(path.at[j]));
      changed = true;
    }
    if (!changed) return;
  }
}

void keep_node_in_band(const Scene& scene, Path& path, int j) {
  path.at[j].z() = std::clamp(path.at[j].z(), path.ground_m[j] + scene.spec.height_min_m + 2.0 * kGuard_m,
                              path.ground_m[j] + scene.spec.height_max_m - 2.0 * kGuard_m);
}

void lift(const Scene& scene, Path& path, int j, double by_m) {
  if (j == 0 || j + 1 == path.points) return;
  path.at[j].z() += by_m;
  keep_node_in_band(scene, path, j);
}

/// True if the segment kept slope and band; else its nodes have been moved towards that.
bool repair_heights_of(const Scene& scene, Path& path, int j) {
  const double run_m = (level(path.at[j + 1]) - level(path.at[j])).norm();
  const double rise_m = path.at[j + 1].z() - path.at[j].z();
  const double steepest_m = scene.slope_max * (1.0 - kGuardShare) * run_m;
  if (std::abs(rise_m) > steepest_m) {
    const double each_m = 0.51 * (std::abs(rise_m) - steepest_m) * (rise_m > 0.0 ? 1.0 : -1.0);
    lift(scene, path, j, each_m);
    lift(scene, path, j + 1, -each_m);
    return false;
  }
  const BandExcess excess = scene.ground.excess(
      path.at[j], path.at[j + 1], scene.spec.height_min_m + kGuard_m, scene.spec.height_max_m - kGuard_m);
  if (excess.none()) return true;
  const double by_m =
      1.05 * (excess.below_m - excess.above_m) + (excess.below_m > 0.0 ? kGuard_m : -kGuard_m);
  lift(scene, path, j, by_m);
  lift(scene, path, j + 1, by_m);
  return false;
}

/// True if in the end every segment keeps slope and band.
bool repair_heights(const Scene& scene, Path& path) {
  for (int j = 0; j < path.points; ++j) {
    path.ground_m[j] = scene.ground.height_at(path.at[j].x(), path.at[j].y());
    if (j > 0 && j + 1 < path.points) keep_node_in_band(scene, path, j);
  }
  std::array<bool, NavigationProblem::kMaxNodes + 1> fine{};
  for (int pass = 0; pass < kHeightPasses; ++pass) {
    bool all_fine = true;
    for (int j = 0; j < path.segments(); ++j) {
      if (fine[j]) continue;
      fine[j] = repair_heights_of(scene, path, j);
      if (fine[j]) continue;
      all_fine = false;
      if (j > 0) fine[j - 1] = false;
      if (j + 1 < path.segments()) fine[j + 1] = false;
    }
    if (all_fine) return true;
  }
  return false;
}

/// Everything that is cheap to look at.
bool angles_and_lengths_hold(const Scene& scene, const Path& path) {
  const NavigationSpec& spec = scene.spec;
  const double turn_max = spec.turn_max_rad * (1.0 - kGuardShare);
  const double climb_max = spec.climb_max_rad * (1.0 - kGuardShare);
  double heading = scene.bearing_rad;
  double climb = 0.0;
  for (int j = 0; j < path.segments(); ++j) {
    const Vec3 d = path.at[j + 1] - path.at[j];
    const double next_heading = std::atan2(d.y(), d.x());
    const double next_climb = std::atan2(d.z(), level(d).norm());
    if (d.norm() < scene.segment_min_m * (1.0 + kGuardShare)) return false;
    if (std::abs(wrapped(next_heading - heading)) > turn_max) return false;
    if (std::abs(next_climb) > climb_max || std::abs(next_climb - climb) > climb_max) return false;
    heading = next_heading;
    climb = next_climb;
  }
  return true;
}

bool plan_holds(const Scene& scene, const Path& path) {
  const NavigationSpec& spec = scene.spec;
  for (int j = 0; j < path.segments(); ++j) {
    const Vec2 a = level(path.at[j]);
    const Vec2 d = level(path.at[j + 1]) - a;
    if ((a.array() < spec.box_min_m.array()).any() || (a.array() > spec.box_max_m.array()).any())
      return false;
    if (std::abs(wrapped(heading_rad(path, j) - (j == 0 ? scene.bearing_rad : heading_rad(path, j - 1)))) >
        spec.turn_max_rad * (1.0 - kGuardShare)) {
      return false;
    }
    for (const NavigationSpec::Threat& threat : spec.threats) {
      const double keep_m = spec.vehicle_size_m + threat.radius_m + 0.5 * kGuard_m;
      const double t = std::clamp((threat.center_m - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
      if (!((a + t * d - threat.center_m).norm() >= keep_m)) return false;
    }
  }
  return true;
}

}  // namespace

bool repair(const Scene& scene, Path& path) {
  repair_plan(scene, path);
  return plan_holds(scene, path) && repair_heights(scene, path) && angles_and_lengths_hold(scene, path);
}

}  // namespace swallowtail::planner::navigation
