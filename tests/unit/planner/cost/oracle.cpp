#include "tests/unit/planner/cost/oracle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace swallowtail::planner::test {
namespace {

constexpr double kPi = std::numbers::pi;

double elevation(const TerrainGrid& g, int row, int col) {
  return g.elevation_m[static_cast<std::size_t>(std::clamp(row, 0, g.rows - 1) * g.cols +
                                                std::clamp(col, 0, g.cols - 1))];
}

double ground(const TerrainGrid& g, double x, double y) {
  const double u = std::clamp((x - g.origin_m.x()) / g.cell_size_m, 0.0, g.cols - 1.0);
  const double v = std::clamp((y - g.origin_m.y()) / g.cell_size_m, 0.0, g.rows - 1.0);
  const int c = std::min(static_cast<int>(u), g.cols - 2);
  const int r = std::min(static_cast<int>(v), g.rows - 2);
  const double south = elevation(g, r, c) + (u - c) * (elevation(g, r, c + 1) - elevation(g, r, c));
  const double north =
      elevation(g, r + 1, c) + (u - c) * (elevation(g, r + 1, c + 1) - elevation(g, r + 1, c));
  return south + (v - r) * (north - south);
}

double nearest_sample(const TerrainGrid& g, double x, double y) {
  return elevation(g, static_cast<int>(std::floor((y - g.origin_m.y()) / g.cell_size_m + 0.5)),
                   static_cast<int>(std::floor((x - g.origin_m.x()) / g.cell_size_m + 0.5)));
}

/// Calls piece(t0, t1, c0, c1, c2) with the height above ground c0 + c1 s + c2 s², s = (t − t0)/(t1 − t0), of
/// every part of a–b over one cell; the coefficients are fitted to three heights.
void over_cells(const TerrainGrid& g, const Vec3& a, const Vec3& b,
                const std::function<void(double, double, double, double, double)>& piece) {
  std::vector<double> cuts = {0.0, 1.0};
  for (int axis = 0; axis < 2; ++axis) {
    const int lines = axis == 0 ? g.cols : g.rows;
    for (int i = 0; i < lines; ++i) {
      const double t = (g.origin_m[axis] + i * g.cell_size_m - a[axis]) / (b[axis] - a[axis]);
      if (t > 0.0 && t < 1.0) cuts.push_back(t);
    }
  }
  std::ranges::sort(cuts);
  const auto height = [&](double t) {
    const Vec3 p = a + t * (b - a);
    return p.z() - ground(g, p.x(), p.y());
  };
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double t0 = cuts[i - 1];
    const double t1 = cuts[i];
    const double h0 = height(t0);
    const double h1 = height(0.5 * (t0 + t1));
    const double h2 = height(t1);
    piece(t0, t1, h0, 4.0 * h1 - 3.0 * h0 - h2, 2.0 * (h0 + h2) - 4.0 * h1);
  }
}

double length_below(const OracleScene& scene, const Vec3& a, const Vec3& b) {
  double share = 0.0;
  over_cells(scene.ground, a, b, [&](double t0, double t1, double c0, double c1, double c2) {
    const auto h = [&](double s) { return c0 + s * (c1 + s * c2) - scene.ground_clearance_m; };
    // A quadratic changes its sign at most twice: once on each side of its vertex.
    std::vector<double> parts = {0.0, 1.0};
    if (const double vertex = -0.5 * c1 / c2; vertex > 0.0 && vertex < 1.0)
      parts.insert(parts.begin() + 1, vertex);
    for (std::size_t i = 1; i < parts.size(); ++i) {
      double lo = parts[i - 1];
      double hi = parts[i];
      const bool starts = h(lo) <= 0.0;
      if (starts == (h(hi) <= 0.0)) {
        if (starts) share += (hi - lo) * (t1 - t0);
        continue;
      }
      for (int k = 0; k < 80; ++k) ((h(0.5 * (lo + hi)) <= 0.0) == starts ? lo : hi) = 0.5 * (lo + hi);
      share += (starts ? lo - parts[i - 1] : parts[i] - lo) * (t1 - t0);
    }
  });
  return share * (b - a).norm();
}

double ground_depth(const OracleScene& scene, const Vec3& a, const Vec3& b) {
  double least = std::numeric_limits<double>::infinity();
  over_cells(scene.ground, a, b, [&](double, double, double c0, double c1, double c2) {
    least = std::min({least, c0, c0 + c1 + c2});
    const double vertex = -0.5 * c1 / c2;
    if (vertex > 0.0 && vertex < 1.0) least = std::min(least, c0 + vertex * (c1 + vertex * c2));
  });
  return std::max(0.0, scene.ground_clearance_m - least);
}

/// Distance of a point from a segment, in as many dimensions as the vectors have, by its angles at the ends.
template <class V>
double segment_distance(const V& a, const V& b, const V& p) {
  if ((a - b).norm() == 0.0 || (b - a).dot(p - a) <= 0.0) return (p - a).norm();
  if ((a - b).dot(p - b) <= 0.0) return (p - b).norm();
  const V along = (b - a).normalized();
  return ((p - a) - along * along.dot(p - a)).norm();
}

double angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

double depth_sum(const OracleScene& scene, const std::vector<Vec3>& path, double count_each) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    for (const auto& ball : scene.balls) {
      const double depth =
          ball.radius_m + ball.required_m - segment_distance<Vec3>(path[i - 1], path[i], ball.center_m);
      if (depth > 0.0) sum += count_each + depth;
    }
  }
  return sum;
}

double below_sum(const OracleScene& scene, const std::vector<Vec3>& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += length_below(scene, path[i - 1], path[i]);
  return sum;
}

double spso(const OracleScene& scene, const std::string& objective, const std::vector<Vec3>& path) {
  double sum = 0.0;
  if (objective == "altitude") {
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      const double z = path[i].z() - nearest_sample(scene.ground, path[i].x(), path[i].y());
      sum += z < 0.0 ? 1e5 - z : std::abs(z - 0.5 * (scene.band_min_m + scene.band_max_m));
    }
  } else if (objective == "threat") {
    for (std::size_t i = 1; i < path.size(); ++i) {
      for (const auto& ball : scene.balls) {
        const double d =
            segment_distance<Vec2>(path[i - 1].head<2>(), path[i].head<2>(), ball.center_m.head<2>());
        const double zone = ball.radius_m + 11.0 * scene.clearance_m;
        if (d < ball.radius_m + scene.clearance_m) {
          sum += 1e5 * (zone - d) / (10.0 * scene.clearance_m);
        } else {
          sum += std::max(0.0, zone - d);
        }
      }
    }
  } else {
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      const Vec3 a = path[i] - path[i - 1];
      const Vec3 b = path[i + 1] - path[i];
      const double turn = angle(Vec3(a.x(), a.y(), 0), Vec3(b.x(), b.y(), 0)) * 180.0 / kPi;
      const double climb = std::abs(std::atan(b.z() / std::hypot(b.x(), b.y())) -
                                    std::atan(a.z() / std::hypot(a.x(), a.y()))) *
                           180.0 / kPi;
      sum += (turn > 45.0 ? turn : 0.0) + (climb > 45.0 ? climb : 0.0);
    }
  }
  return sum;
}

double nmopso(const OracleScene& scene, const std::string& objective, const std::vector<Vec3>& path) {
  double length = 0.0;
  double turns = 0.0;
  double threats = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += (path[i] - path[i - 1]).norm();
    if (i + 1 < path.size()) turns += angle(path[i] - path[i - 1], path[i + 1] - path[i]);
    for (const auto& ball : scene.balls) {
      const double d =
          segment_distance<Vec2>(path[i - 1].head<2>(), path[i].head<2>(), ball.center_m.head<2>());
      const double near = 1.0 - (d - scene.clearance_m - ball.radius_m) / scene.danger_m;
      threats += near > 1.0 ? 1.0 + 10.0 * (near - 1.0) : std::max(0.0, near);
    }
  }
  const double corners = static_cast<double>(path.size()) - 2.0;
  if (objective == "F1") return 1.0 - (path.back() - path.front()).norm() / length;
  if (objective == "F2") return threats / ((corners + 1.0) * static_cast<double>(scene.balls.size()));
  if (objective == "F4") return turns / corners / kPi;
  double heights = 0.0;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const double h = path[i].z() - ground(scene.ground, path[i].x(), path[i].y());
    const double off =
        std::abs(2.0 * h - (scene.band_max_m + scene.band_min_m)) / (scene.band_max_m - scene.band_min_m);
    heights += off > 1.0 ? 1.0 + 10.0 * (off - 1.0) : off;
  }
  return heights / corners;
}

double ibabc(const OracleScene& scene, const std::string& objective, const std::vector<Vec3>& path) {
  const double whole = (path.back() - path.front()).norm();
  const auto [lowest, highest] = std::ranges::minmax(scene.ground.elevation_m);
  double top = highest;
  for (const auto& ball : scene.balls) top = std::max(top, ball.center_m.z() + ball.radius_m);
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Vec3 a = path[i] - path[i - 1];
    const Vec3 b = path[i + 1] - path[i];
    const double mean = 0.5 * (a.norm() + b.norm()) / whole;
    double nearest = std::numeric_limits<double>::infinity();
    double threat = 0.0;
    for (const auto& ball : scene.balls) {
      const double w = (path[i] - ball.center_m).norm();
      nearest = std::min(nearest, w - ball.radius_m);
      threat += std::max(0.0, (ball.radius_m - w) / ball.radius_m);
    }
    const double high = std::max(0.0, path[i].z() - top) / (top - lowest);
    const double near = std::max(0.0, scene.danger_m - nearest) / scene.danger_m;
    sum += objective == "smoothness" ? angle(a, b) / mean
           : objective == "threat"   ? threat
                                     : (high + near) * mean;
  }
  return sum;
}

}  // namespace

double oracle(const OracleScene& scene, const std::string& preset, const std::string& objective,
              const std::vector<Vec3>& path) {
  const double whole = (path.back() - path.front()).norm();
  double length = 0.0;
  double range = 0.0;
  double sunk = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double hop = (path[i] - path[i - 1]).norm();
    length += hop;
    if (hop > 3.5) range += 1.0 + (hop - 3.5);
    sunk += ground_depth(scene, path[i - 1], path[i]);
  }
  if (objective == "length")
    return preset == "BOA" || preset == "PSO" || preset == "SPSO" ? length : length / whole;
  if (objective == "range") return range;
  if (objective == "violation") return (depth_sum(scene, path, 0.0) + sunk) / whole;
  if (objective == "collision") return std::pow(depth_sum(scene, path, 1.0) + below_sum(scene, path), 2.0);
  if (objective == "contact") {
    const double depth = depth_sum(scene, path, 0.0) + below_sum(scene, path);
    return depth > 0.0 ? 1.0 + depth / whole : 0.0;
  }
  if (preset == "SPSO") return spso(scene, objective, path);
  return objective.front() == 'F' ? nmopso(scene, objective, path) : ibabc(scene, objective, path);
}

}  // namespace swallowtail::planner::test
