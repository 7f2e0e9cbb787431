#include "tools/cli/terrain/generate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/core.h>

#include "planner/base/checks.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::cli {
namespace {

constexpr double kMaxSamples = 4e6;
constexpr double kRampShare = 0.15;  // ours: of the side, on which farmland climbs

struct Wave {
  Vec2 number = Vec2::Zero();  // rad/m
  double phase = 0.0;
  double weight = 0.0;
};

std::vector<planner::Mountain> draw_mountains(const TerrainParams& params, Rng& rng) {
  std::vector<planner::Mountain> out;
  const double side_m = params.size_m.minCoeff();
  for (int i = 0; i < params.count; ++i) {
    planner::Mountain mountain;
    mountain.x_m = rng.uniform(0.1, 0.9) * params.size_m.x();
    mountain.y_m = rng.uniform(0.1, 0.9) * params.size_m.y();
    mountain.height_m = rng.uniform(0.4, 1.0);
    const double width_m = rng.uniform(0.08, 0.2) * side_m;
    mountain.spread_m2 = width_m * width_m;
    out.push_back(mountain);
  }
  return out;
}

std::vector<Wave> draw_waves(const TerrainParams& params, Rng& rng) {
  std::vector<Wave> out;
  const double side_m = params.size_m.minCoeff();
  for (int i = 0; i < params.count; ++i) {
    const double length_m = rng.uniform(0.25, 0.5) * side_m;
    const double direction = rng.uniform(0.0, std::numbers::pi);
    out.push_back({Vec2(std::cos(direction), std::sin(direction)) * (2.0 * std::numbers::pi / length_m),
                   rng.uniform(0.0, 2.0 * std::numbers::pi), length_m / side_m});
  }
  return out;
}

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Elevation before it is brought to the relief asked for.
class Shape {
 public:
  explicit Shape(const TerrainParams& params) : params_(params) {
    Rng rng(params.seed);
    mountains_ = draw_mountains(params, rng);
    waves_ = draw_waves(params, rng);
    ramp_at_ = rng.uniform(0.35, 0.65);
  }

  double at(const Vec2& p) const {
    double sum = 0.0;
    switch (params_.kind) {
      case TerrainKind::kMountains:
        for (const auto& m : mountains_)
          sum += m.height_m * std::exp(-(p - Vec2(m.x_m, m.y_m)).squaredNorm() / m.spread_m2);
        return sum;
      case TerrainKind::kHills:
        for (const Wave& wave : waves_) sum += wave.weight * std::sin(wave.number.dot(p) + wave.phase);
        return sum;
      case TerrainKind::kFarmland:
        return smooth_step((p.x() / params_.size_m.x() - ramp_at_) / kRampShare + 0.5);
    }
    return sum;
  }

 private:
  TerrainParams params_;
  std::vector<planner::Mountain> mountains_;
  std::vector<Wave> waves_;
  double ramp_at_ = 0.5;
};

}  // namespace

Result<planner::TerrainGrid> generate_terrain(const TerrainParams& params) {
  if (!is_positive(params.size_m.x()) || !is_positive(params.size_m.y()))
    return bad_input("The terrain's size must be positive.");
  if (!is_positive(params.cell_size_m))
    return bad_input(
        fmt::format("The terrain's cell size is {} m; it must be positive.", params.cell_size_m));
  if (!is_positive(params.relief_m) || params.relief_m > 5000.0)
    return bad_input(
        fmt::format("The relief is {} m; it must be above 0 and at most 5000.", params.relief_m));
  if (params.count < 1 || params.count > 1000)
    return bad_input(fmt::format("The count is {}; it must be 1 to 1000.", params.count));
  const double cols = std::ceil(params.size_m.x() / params.cell_size_m) + 1.0;
  const double rows = std::ceil(params.size_m.y() / params.cell_size_m) + 1.0;
  if (cols * rows > kMaxSamples)
    return bad_input(fmt::format("The terrain has {:.0f} × {:.0f} samples; at most {:.0f} are made.", cols,
                                 rows, kMaxSamples));

  planner::TerrainGrid grid;
  grid.cell_size_m = params.cell_size_m;
  grid.cols = static_cast<int>(cols);
  grid.rows = static_cast<int>(rows);
  const Shape shape(params);
  std::vector<double> raw;
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.cols; ++c) raw.push_back(shape.at(Vec2(c, r) * params.cell_size_m));
  }
  const auto [lo, hi] = std::ranges::minmax(raw);
  const double scale = hi > lo ? params.relief_m / (hi - lo) : 0.0;
  for (const double value : raw)
    grid.elevation_m.push_back(static_cast<float>(std::round((value - lo) * scale * 100.0) / 100.0));
  return grid;
}

}  // namespace swallowtail::cli
