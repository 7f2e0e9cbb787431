#include "tests/support/oracle.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace swallowtail::test {
namespace {

using planner::Phase;

double segment_point_distance(double px, double py, double ax, double ay, double bx, double by) {
  const double dx = bx - ax;
  const double dy = by - ay;
  double t = ((px - ax) * dx + (py - ay) * dy) / (dx * dx + dy * dy);
  t = t < 0.0 ? 0.0 : (t > 1.0 ? 1.0 : t);
  return std::hypot(px - ax - t * dx, py - ay - t * dy);
}

double cylinder_distance(double radius, double height, const Vec3& x) {
  const double out = std::hypot(x.x(), x.y()) - radius;
  const double over = std::max(-x.z(), x.z() - height);
  if (out <= 0.0 && over <= 0.0) return 0.0;
  if (out <= 0.0) return over;
  if (over <= 0.0) return out;
  return std::sqrt(out * out + over * over);
}

/// In the half plane the cone is a triangle: inside by its three sides, else the nearest side.
double cone_distance(double radius, double height, const Vec3& x) {
  const double rho = std::hypot(x.x(), x.y());
  if (x.z() >= 0.0 && x.z() <= height && rho <= radius * (1.0 - x.z() / height)) return 0.0;
  return std::min(segment_point_distance(rho, x.z(), 0.0, 0.0, radius, 0.0),
                  segment_point_distance(rho, x.z(), radius, 0.0, 0.0, height));
}

Vec3 unturned(const Vec3& x, double yaw) {
  return {x.x() * std::cos(-yaw) - x.y() * std::sin(-yaw), x.x() * std::sin(-yaw) + x.y() * std::cos(-yaw),
          x.z()};
}

double box_distance(const Vec3& size, const Vec3& x) {
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double beyond = std::abs(x[axis]) - size[axis] / 2.0;
    if (beyond > 0.0) square += beyond * beyond;
  }
  return std::sqrt(square);
}

/// Distance to a triangle: its plane if the foot lies inside, else its sides.
double triangle_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
  const Vec3 normal = (b - a).cross(c - a);
  const auto inside_of = [&](const Vec3& u, const Vec3& v) {
    return normal.dot((v - u).cross(x - u)) >= 0.0;
  };
  if (inside_of(a, b) && inside_of(b, c) && inside_of(c, a))
    return std::abs(normal.dot(x - a)) / normal.norm();
  const auto side = [&](const Vec3& u, const Vec3& v) {
    const double t = std::min(1.0, std::max(0.0, (x - u).dot(v - u) / (v - u).dot(v - u)));
    return (x - (u + t * (v - u))).norm();
  };
  return std::min({side(a, b), side(b, c), side(c, a)});
}

/// Every three vertices whose plane has all others on one side make a part of a face.
double hull_distance(const std::vector<Vec3>& v, const Vec3& x) {
  double nearest = std::numeric_limits<double>::infinity();
  bool outside = false;
  for (std::size_t i = 0; i < v.size(); ++i) {
    for (std::size_t j = i + 1; j < v.size(); ++j) {
      for (std::size_t k = j + 1; k < v.size(); ++k) {
        Vec3 normal = (v[j] - v[i]).cross(v[k] - v[i]);
        if (normal.norm() < 1e-9) continue;
        normal /= normal.norm();
        double most = 0.0;
        double least = 0.0;
        for (const Vec3& w : v) {
          most = std::max(most, normal.dot(w - v[i]));
          least = std::min(least, normal.dot(w - v[i]));
        }
        if (most > 1e-9 && least < -1e-9) continue;
        const double height = normal.dot(x - v[i]) * (most > 1e-9 ? -1.0 : 1.0);
        outside = outside || height > 0.0;
        nearest = std::min(nearest, triangle_distance(v[i], v[j], v[k], x));
      }
    }
  }
  return outside ? nearest : 0.0;
}

double raster_sample(const planner::TerrainGrid& grid, int row, int col) {
  return static_cast<double>(grid.elevation_m[static_cast<std::size_t>(row * grid.cols + col)]);
}

struct Sample {
  double time_s;
  Vec3 place;
};

/// One segment's samples, both ends included.
std::vector<Sample> samples_of(const planner::TimedWaypoint& from, const planner::TimedWaypoint& to,
                               double fastest_mps, double step_m) {
  const double travel = (to.position_m - from.position_m).norm() + fastest_mps * (to.time_s - from.time_s);
  const int count = std::max(1, static_cast<int>(std::ceil(travel / step_m)));
  std::vector<Sample> samples;
  for (int i = 0; i <= count; ++i) {
    const double s = static_cast<double>(i) / count;
    samples.push_back(
        {(1.0 - s) * from.time_s + s * to.time_s, (1.0 - s) * from.position_m + s * to.position_m});
  }
  return samples;
}

void inspect_obstacles(const std::vector<Sample>& samples, const World& world, double required_m,
                       Opinion& opinion) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (const Obstacle& obstacle : world.obstacles()) {
      if (samples[i].time_s > obstacle.valid_until_s) continue;
      const Vec3 centre =
          obstacle.position_m + (samples[i].time_s - obstacle.state_time_s) * obstacle.velocity_mps;
      const double distance = point_distance_m(obstacle.shape, samples[i].place - centre);
      opinion.obstacle_excess_m =
          std::max(opinion.obstacle_excess_m, required_m + obstacle.margin_m - distance);
    }
  }
}

void inspect_ground(const std::vector<Sample>& samples, const World& world, double required_m, double step_m,
                    double highest_m, Opinion& opinion) {
  for (const Sample& sample : samples) {
    const Vec3& p = sample.place;
    const double height = p.z() - ground_m(world, p.x(), p.y());
    opinion.terrain_height_m = std::min(opinion.terrain_height_m, height);
    opinion.terrain_excess_m = std::max(opinion.terrain_excess_m, required_m - height);
    if (p.z() - highest_m >= required_m || height <= 0.0) continue;
    for (double dx = -required_m; dx <= required_m; dx += step_m) {
      for (double dy = -required_m; dy <= required_m; dy += step_m) {
        const double dz = p.z() - ground_m(world, p.x() + dx, p.y() + dy);
        opinion.terrain_excess_m =
            std::max(opinion.terrain_excess_m, required_m - std::sqrt(dx * dx + dy * dy + dz * dz));
      }
    }
  }
}

double highest_ground_m(const World& world) {
  const planner::TerrainGrid* grid = world.terrain().grid();
  if (grid == nullptr) return world.terrain().flat_elevation_m();
  return static_cast<double>(*std::max_element(grid->elevation_m.begin(), grid->elevation_m.end()));
}

bool goes_straight_up_or_down(const Vec3& move) { return std::hypot(move.x(), move.y()) <= 1e-6; }

void inspect_motion(const TimedPath& path, const VehicleLimits& limits, Opinion& opinion) {
  const Vec3* before = nullptr;
  Vec3 kept;
  double stood_s = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec3 move = path[i].position_m - path[i - 1].position_m;
    const double took_s = path[i].time_s - path[i - 1].time_s;
    if (move.norm() <= 1e-6) {
      stood_s += took_s;
      continue;
    }
    const bool vertical = goes_straight_up_or_down(move);
    if (!vertical) {
      opinion.speed_excess =
          std::max(opinion.speed_excess, move.norm() / took_s / limits.cruise_speed_mps - 1.0);
      opinion.climb_excess_rad = std::max(opinion.climb_excess_rad,
                                          std::asin(std::abs(move.z()) / move.norm()) - limits.climb_max_rad);
    }
    opinion.speed_excess = std::max(opinion.speed_excess, move.z() / took_s / limits.climb_speed_mps - 1.0);
    opinion.speed_excess =
        std::max(opinion.speed_excess, -move.z() / took_s / limits.descent_speed_mps - 1.0);
    if (before != nullptr && stood_s < 1.0 - 2e-6) {
      double turn = std::acos(std::clamp(before->dot(move) / before->norm() / move.norm(), -1.0, 1.0));
      if (vertical != goes_straight_up_or_down(*before)) turn = std::max(turn, std::acos(0.0));
      opinion.turn_excess_rad = std::max(opinion.turn_excess_rad, turn - limits.turn_max_rad);
    }
    kept = move;
    before = &kept;
    stood_s = 0.0;
  }
}

}  // namespace

double point_distance_m(const Shape& shape, const Vec3& x) {
  if (const auto* s = std::get_if<planner::Sphere>(&shape)) return std::max(0.0, x.norm() - s->radius_m);
  if (const auto* c = std::get_if<planner::Cylinder>(&shape))
    return cylinder_distance(c->radius_m, c->height_m, x);
  if (const auto* c = std::get_if<planner::Cone>(&shape)) return cone_distance(c->radius_m, c->height_m, x);
  if (const auto* b = std::get_if<planner::Box>(&shape))
    return box_distance(b->size_m, unturned(x, b->yaw_rad));
  const auto& mesh = std::get<planner::ConvexMesh>(shape);
  return hull_distance(mesh.vertices_m, unturned(x, mesh.yaw_rad));
}

double ground_m(const World& world, double x_m, double y_m) {
  const planner::TerrainGrid* grid = world.terrain().grid();
  if (grid == nullptr) return world.terrain().flat_elevation_m();
  const double u = std::min(std::max((x_m - grid->origin_m.x()) / grid->cell_size_m, 0.0), grid->cols - 1.0);
  const double v = std::min(std::max((y_m - grid->origin_m.y()) / grid->cell_size_m, 0.0), grid->rows - 1.0);
  const int c = std::min(static_cast<int>(std::floor(u)), grid->cols - 2);
  const int r = std::min(static_cast<int>(std::floor(v)), grid->rows - 2);
  const double south =
      raster_sample(*grid, r, c) + (u - c) * (raster_sample(*grid, r, c + 1) - raster_sample(*grid, r, c));
  const double north = raster_sample(*grid, r + 1, c) +
                       (u - c) * (raster_sample(*grid, r + 1, c + 1) - raster_sample(*grid, r + 1, c));
  return south + (v - r) * (north - south);
}

Opinion inspect(const TimedPath& path, const World& world, const VehicleLimits& limits,
                const OracleSteps& steps) {
  Opinion opinion;
  const double required_m = limits.radius_m + limits.margin_m;
  const double highest_m = highest_ground_m(world);
  double fastest_mps = 0.0;
  for (const Obstacle& obstacle : world.obstacles())
    fastest_mps = std::max(fastest_mps, obstacle.velocity_mps.norm());
  opinion.obstacle_resolution_m =
      steps.path_m;  // half a step between samples, a whole one before an obstacle's end
  for (const auto& waypoint : path) {
    for (int axis = 0; axis < 3; ++axis) {
      opinion.bounds_excess_m =
          std::max({opinion.bounds_excess_m, world.bounds().min_m[axis] - waypoint.position_m[axis],
                    waypoint.position_m[axis] - world.bounds().max_m[axis]});
    }
  }
  for (std::size_t i = path.size() == 1 ? 0 : 1; i < path.size(); ++i) {
    const auto& from = path[i == 0 ? 0 : i - 1];
    const auto samples = samples_of(from, path[i], fastest_mps, steps.path_m);
    inspect_obstacles(samples, world, required_m, opinion);
    const bool touches_down = path[i].phase == Phase::kTakeOff || path[i].phase == Phase::kLanding;
    if (touches_down && goes_straight_up_or_down(path[i].position_m - from.position_m)) {
      for (const Sample& s : samples)
        opinion.below_ground_m =
            std::max(opinion.below_ground_m, ground_m(world, s.place.x(), s.place.y()) - s.place.z());
    } else {
      inspect_ground(samples, world, required_m, steps.ground_m, highest_m, opinion);
    }
  }
  inspect_motion(path, limits, opinion);
  return opinion;
}

}  // namespace swallowtail::test
