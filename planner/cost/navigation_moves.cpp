#include <algorithm>

#include "planner/cost/navigation_path.hpp"

namespace swallowtail::planner::navigation {
namespace {

Vec2 level(const Vec3& p) { return p.head<2>(); }

/// A window of nodes: all of them or a few around one.
struct Window {
  int first = 1;
  int last = 1;
};
Window draw_window(const Path& path, Rng& rng) {
  const int nodes = path.points - 2;
  if (rng.uniform() < 0.3) return {1, nodes};
  const int center = 1 + static_cast<int>(rng.below(static_cast<std::uint64_t>(nodes)));
  const int reach = static_cast<int>(rng.below(3));
  return {std::max(1, center - reach), std::min(nodes, center + reach)};
}

/// Sizes over six octaves: far and fine moves are as likely.
double draw_size(Rng& rng) { return std::exp2(-8.0 * rng.uniform()); }

void move_level(const Scene& scene, Path& path, int j, const Vec2& by, bool keep_height) {
  path.at[j].head<2>() += by;
  if (!keep_height) return;
  const double ground_m = scene.ground.height_at(path.at[j].x(), path.at[j].y());
  path.at[j].z() += ground_m - path.ground_m[j];
  path.ground_m[j] = ground_m;
}

void bump(const Scene& scene, Path& path, Rng& rng) {
  const Window window = draw_window(path, rng);
  const double size_m = draw_size(rng) * scene.distance_m / path.segments();
  const Vec2 by(size_m * rng.normal(), size_m * rng.normal());
  const bool keep_height = rng.uniform() < 0.5;
  const double reach = 0.5 * (window.last - window.first) + 1.0;
  const double center = 0.5 * (window.last + window.first);
  for (int j = window.first; j <= window.last; ++j) {
    const double off = (j - center) / reach;
    move_level(scene, path, j, (1.0 - off * off) * by, keep_height);
  }
}

/// Towards the chord of the neighbours, or beyond it.
void straighten(const Scene& scene, Path& path, Rng& rng) {
  const Window window = draw_window(path, rng);
  const double share = rng.uniform(-0.2, 1.0);
  const bool level_only = rng.uniform() < 0.5;
  for (int j = window.first; j <= window.last; ++j) {
    const Vec3 by = share * (0.5 * (path.at[j - 1] + path.at[j + 1]) - path.at[j]);
    move_level(scene, path, j, level(by), level_only);
    if (!level_only) path.at[j].z() += by.z();
  }
}

void slide(const Scene& scene, Path& path, Rng& rng) {
  const Window window = draw_window(path, rng);
  const double share = 0.5 * rng.uniform();
  const int towards = rng.uniform() < 0.5 ? -1 : 1;
  const bool keep_height = rng.uniform() < 0.5;
  for (int j = window.first; j <= window.last; ++j) {
    const Vec3 by = share * (path.at[j + towards] - path.at[j]);
    move_level(scene, path, j, level(by), keep_height);
    if (!keep_height) path.at[j].z() += by.z();
  }
}

void change_heights(const Scene& scene, Path& path, Rng& rng) {
  const Window window = draw_window(path, rng);
  const double share = rng.uniform();
  const double by_m = draw_size(rng) * scene.half_band_m() * rng.normal();
  const std::uint64_t kind = rng.below(3);
  for (int j = window.first; j <= window.last; ++j) {
    double& z = path.at[j].z();
    if (kind == 0) z += by_m;
    if (kind == 1) z += share * (path.ground_m[j] + scene.middle_m() - z);
    if (kind == 2) {
      // To where the line between the neighbours passes here.
      const double before = (level(path.at[j]) - level(path.at[j - 1])).norm();
      const double after = (level(path.at[j + 1]) - level(path.at[j])).norm();
      const double t = before / std::max(before + after, 1e-12);
      z += share * ((1.0 - t) * path.at[j - 1].z() + t * path.at[j + 1].z() - z);
    }
  }
}

}  // namespace

void shake(const Scene& scene, Path& path, Rng& rng) {
  const double kind = rng.uniform();
  if (kind < 0.35) {
    bump(scene, path, rng);
  } else if (kind < 0.55) {
    straighten(scene, path, rng);
  } else if (kind < 0.65) {
    slide(scene, path, rng);
  } else {
    change_heights(scene, path, rng);
  }
}

void bow(const Scene& scene, Path& path, Rng& rng) {
  const NavigationSpec& spec = scene.spec;
  path.points = spec.nodes + 2;
  path.at[0] = spec.start_m;
  path.at[path.points - 1] = spec.goal_m;
  const Vec2 line = level(spec.goal_m) - level(spec.start_m);
  const Vec2 side = Vec2(-line.y(), line.x());
  const double first = 0.25 * rng.normal();
  const double second = 0.12 * rng.normal();
  const double third = 0.06 * rng.normal();
  const double height_m = scene.middle_m() + 0.5 * scene.half_band_m() * rng.normal();
  for (int j = 0; j < path.points; ++j) {
    const double s = static_cast<double>(j) / path.segments();
    const double phase = std::numbers::pi * s;
    const double sway = first * std::sin(phase) + second * std::sin(2 * phase) + third * std::sin(3 * phase);
    if (j > 0 && j + 1 < path.points) {
      path.at[j].head<2>() =
          (level(spec.start_m) + s * line + sway * side).cwiseMax(spec.box_min_m).cwiseMin(spec.box_max_m);
    }
    path.ground_m[j] = scene.ground.height_at(path.at[j].x(), path.at[j].y());
    if (j > 0 && j + 1 < path.points) path.at[j].z() = path.ground_m[j] + height_m;
  }
  for (std::uint64_t smooth = rng.below(12); smooth > 0; --smooth) {
    for (int j = 1; j + 1 < path.points; ++j) {
      path.at[j].z() = 0.5 * path.at[j].z() + 0.25 * (path.at[j - 1].z() + path.at[j + 1].z());
    }
  }
}

}  // namespace swallowtail::planner::navigation
