#include "tools/bench/plot/scene_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <variant>

#include "tools/bench/plot/chart.hpp"
#include "tools/drawing/svg.hpp"

namespace swallowtail::bench {
namespace {

using report::Points;
using report::Svg;

constexpr double kWidth = 900.0;
constexpr double kHeight = 620.0;
constexpr double kPad = 30.0;
constexpr int kMeshLines = 40;
constexpr int kCorners = 24;
constexpr std::size_t kMostObstacles = 400;

/// Isometric: east goes right and up, north left and up, height up.
std::pair<double, double> flattened(const Vec3& p) {
  const double c = std::cos(std::numbers::pi / 6.0);
  return {c * (p.x() - p.y()), -0.5 * (p.x() + p.y()) - p.z()};
}

class View {
 public:
  explicit View(const planner::Bounds& box) {
    for (int corner = 0; corner < 8; ++corner) {
      const auto [u, v] = flattened(corner_of(box, corner));
      u_min_ = std::min(u_min_, u);
      v_min_ = std::min(v_min_, v);
      u_max_ = std::max(u_max_, u);
      v_max_ = std::max(v_max_, v);
    }
    scale_ = std::min((kWidth - 2 * kPad) / (u_max_ - u_min_), (kHeight - 2 * kPad) / (v_max_ - v_min_));
  }
  std::pair<double, double> operator()(const Vec3& p) const {
    const auto [u, v] = flattened(p);
    return {kPad + scale_ * (u - u_min_), kPad + scale_ * (v - v_min_)};
  }
  double scale() const { return scale_; }
  static Vec3 corner_of(const planner::Bounds& box, int corner) {
    return {(corner & 1) != 0 ? box.max_m.x() : box.min_m.x(),
            (corner & 2) != 0 ? box.max_m.y() : box.min_m.y(),
            (corner & 4) != 0 ? box.max_m.z() : box.min_m.z()};
  }

 private:
  double u_min_ = std::numeric_limits<double>::infinity();
  double v_min_ = std::numeric_limits<double>::infinity();
  double u_max_ = -std::numeric_limits<double>::infinity();
  double v_max_ = -std::numeric_limits<double>::infinity();
  double scale_ = 1.0;
};

void draw_box(Svg& svg, const View& view, const planner::Bounds& box) {
  for (int a = 0; a < 8; ++a) {
    for (const int axis : {1, 2, 4}) {
      if ((a & axis) != 0) continue;
      const auto [x0, y0] = view(View::corner_of(box, a));
      const auto [x1, y1] = view(View::corner_of(box, a | axis));
      svg.line(x0, y0, x1, y1, "stroke=\"#b6c2cc\" stroke-dasharray=\"3 3\"");
    }
  }
}

void draw_ground(Svg& svg, const View& view, const planner::World& world) {
  if (world.terrain().is_flat()) return;
  const planner::Bounds& box = world.bounds();
  const Vec3 span = box.max_m - box.min_m;
  for (const bool northward : {false, true}) {
    for (int line = 0; line <= kMeshLines; ++line) {
      Points pixels;
      for (int i = 0; i <= 2 * kMeshLines; ++i) {
        const double along = static_cast<double>(i) / (2.0 * kMeshLines);
        const double across = static_cast<double>(line) / kMeshLines;
        const double x = box.min_m.x() + span.x() * (northward ? across : along);
        const double y = box.min_m.y() + span.y() * (northward ? along : across);
        pixels.push_back(view({x, y, world.terrain().height_at(x, y)}));
      }
      svg.polyline(pixels, "stroke=\"#8aa37b\" stroke-width=\"0.6\" stroke-opacity=\"0.7\"");
    }
  }
}

Points circle(const View& view, const Vec3& center, double radius_m) {
  Points pixels;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    pixels.push_back(view(center + radius_m * Vec3(std::cos(angle), std::sin(angle), 0.0)));
  }
  return pixels;
}

void draw_obstacle(Svg& svg, const View& view, const planner::Obstacle& obstacle) {
  const std::string style = "fill=\"#c98f6b\" fill-opacity=\"0.30\" stroke=\"#8a5a3b\" stroke-width=\"0.7\"";
  const Vec3& at = obstacle.position_m;
  const std::string tooltip = "obstacle " + std::to_string(obstacle.id);
  if (const auto* sphere = std::get_if<planner::Sphere>(&obstacle.shape)) {
    const auto [x, y] = view(at);
    // An isometric view stretches what it shows by this much along the steepest direction.
    svg.circle(x, y, 1.2 * view.scale() * sphere->radius_m, style, tooltip);
    return;
  }
  if (const auto* cylinder = std::get_if<planner::Cylinder>(&obstacle.shape)) {
    svg.rings({circle(view, at, cylinder->radius_m)}, style, tooltip);
    svg.rings({circle(view, at + Vec3(0, 0, cylinder->height_m), cylinder->radius_m)}, style, tooltip);
    return;
  }
  if (const auto* cone = std::get_if<planner::Cone>(&obstacle.shape)) {
    svg.rings({circle(view, at, cone->radius_m)}, style, tooltip);
    const auto [x, y] = view(at + Vec3(0, 0, cone->height_m));
    for (const auto& [bx, by] : circle(view, at, cone->radius_m))
      svg.line(x, y, bx, by, "stroke=\"#8a5a3b\" stroke-width=\"0.4\"");
    return;
  }
  const planner::Extent extent = planner::extent(obstacle.shape);
  for (const double z : {extent.min_m.z(), extent.max_m.z()}) {
    svg.rings({{view(at + Vec3(extent.min_m.x(), extent.min_m.y(), z)),
                view(at + Vec3(extent.max_m.x(), extent.min_m.y(), z)),
                view(at + Vec3(extent.max_m.x(), extent.max_m.y(), z)),
                view(at + Vec3(extent.min_m.x(), extent.max_m.y(), z))}},
              style, tooltip);
  }
}

/// The obstacles to draw: those nearest to the path's points when there are too many.
std::vector<const planner::Obstacle*> chosen(const planner::World& world,
                                             const std::vector<ViewedPath>& paths) {
  std::vector<std::pair<double, const planner::Obstacle*>> near;
  for (const planner::Obstacle& obstacle : world.obstacles()) {
    double distance_m = std::numeric_limits<double>::infinity();
    if (!paths.empty()) {
      for (const Vec3& p : paths.front().points_m)
        distance_m = std::min(distance_m, (p - obstacle.position_m).norm());
    }
    near.emplace_back(distance_m, &obstacle);
  }
  std::ranges::stable_sort(near, {}, &std::pair<double, const planner::Obstacle*>::first);
  if (near.size() > kMostObstacles) near.resize(kMostObstacles);
  std::vector<const planner::Obstacle*> kept;
  for (const auto& [distance_m, obstacle] : near) kept.push_back(obstacle);
  return kept;
}

}  // namespace

std::string draw_scene(const std::string& title, const planner::World& world,
                       const std::vector<ViewedPath>& paths) {
  Svg svg(kWidth, kHeight, title);
  const View view(world.bounds());
  svg.rect(0, 0, kWidth, kHeight, "fill=\"#ffffff\"");
  svg.text(0.5 * kWidth, 18, title, "text-anchor=\"middle\" font-weight=\"bold\"");
  draw_box(svg, view, world.bounds());
  draw_ground(svg, view, world);
  for (const planner::Obstacle* obstacle : chosen(world, paths)) draw_obstacle(svg, view, *obstacle);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    Points pixels;
    for (const Vec3& p : paths[i].points_m) pixels.push_back(view(p));
    svg.polyline(pixels, std::string("stroke-width=\"2\" stroke=\"") + color_of(i) + "\"");
    const double y = 30.0 + 16.0 * static_cast<double>(i);
    svg.rect(10, y, 10, 10, std::string("fill=\"") + color_of(i) + "\"");
    svg.text(25, y + 10, paths[i].name);
  }
  return svg.finish();
}

}  // namespace swallowtail::bench
