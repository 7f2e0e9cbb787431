#include "coverage/ground/rough_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTouch_m = 1e-9;

struct Move {
  int rows;
  int cols;
};
constexpr std::array<Move, 16> kMoves{{{0, 1},
                                       {1, 0},
                                       {0, -1},
                                       {-1, 0},
                                       {1, 1},
                                       {1, -1},
                                       {-1, 1},
                                       {-1, -1},
                                       {1, 2},
                                       {2, 1},
                                       {-1, 2},
                                       {-2, 1},
                                       {1, -2},
                                       {2, -1},
                                       {-1, -2},
                                       {-2, -1}}};

float length_of(const Move& move) {
  return static_cast<float>(std::sqrt(move.rows * move.rows + move.cols * move.cols));
}

/// Whether a segment meets a box: clipped by its four sides.
bool meets(const Vec2& from, const Vec2& to, const Vec2& lo, const Vec2& hi) {
  double first = 0.0;
  double last = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double way = to[axis] - from[axis];
    if (std::abs(way) < kTouch_m) {
      if (from[axis] < lo[axis] || from[axis] > hi[axis]) return false;
      continue;
    }
    const double a = (lo[axis] - from[axis]) / way;
    const double b = (hi[axis] - from[axis]) / way;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

}  // namespace

Status validate(const RoughGroundParams& params) {
  if (!is_finite(params.lo_m) || !is_finite(params.hi_m) || !((params.hi_m - params.lo_m).minCoeff() > 0.0))
    return bad_input("The ground that the robot may use must be a box of some size.");
  if (!is_positive(params.cell_m)) return bad_input("The robot's ground must have cells of a positive size.");
  if (!is_positive(params.speed_mps)) return bad_input("The robot's speed must be positive.");
  if (!is_within(params.slope_max_rad, 0.0, 1.5))
    return bad_input("The steepest slope that the robot climbs must be 0 to 1.5 rad.");
  return {};
}

Result<std::shared_ptr<const RoughGround>> RoughGround::make(const RoughGroundParams& params,
                                                             const planner::Terrain& terrain) {
  if (const Status status = validate(params); !status) return status.error();
  return std::shared_ptr<const RoughGround>(new RoughGround(params, terrain));
}

RoughGround::RoughGround(const RoughGroundParams& params, const planner::Terrain& terrain) : params_(params) {
  const Vec2 size = params_.hi_m - params_.lo_m;
  params_.cell_m = std::max(params_.cell_m, std::sqrt(size.x() * size.y() / kMaxGroundCells));
  cols_ = std::max(1, static_cast<int>(std::ceil(size.x() / params_.cell_m)));
  rows_ = std::max(1, static_cast<int>(std::ceil(size.y() / params_.cell_m)));
  open_.assign(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_), 1);
  const double slope_max = std::tan(params_.slope_max_rad);
  const Vec2 half = Vec2::Constant(params_.cell_m / 2.0);
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const Vec2 middle = centre(static_cast<int>(i));
    if (terrain.max_slope_in(middle - half, middle + half) > slope_max) open_[i] = 0;
  }
  for (const Polygon& polygon : params_.forbidden) {
    const auto shut = [&](const Ring& ring) {
      for (std::size_t i = 0; i < open_.size(); ++i) {
        const Vec2 middle = centre(static_cast<int>(i));
        for (std::size_t k = 0; k < ring.size() && open_[i] != 0; ++k) {
          if (meets(ring[k], ring[(k + 1) % ring.size()], middle - half, middle + half)) open_[i] = 0;
        }
      }
    };
    shut(polygon.outline);
    for (const Ring& hole : polygon.holes) shut(hole);
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (open_[i] != 0 && contains(polygon, centre(static_cast<int>(i)))) open_[i] = 0;
    }
  }
}

Vec2 RoughGround::centre(int cell) const {
  return params_.lo_m + params_.cell_m * Vec2(cell % cols_ + 0.5, cell / cols_ + 0.5);
}

bool RoughGround::is_open(int row, int col) const {
  return row >= 0 && row < rows_ && col >= 0 && col < cols_ &&
         open_[static_cast<std::size_t>(row * cols_ + col)] != 0;
}

int RoughGround::cell_at(const Vec2& place) const {
  const Vec2 at = (place - params_.lo_m) / params_.cell_m;
  if (!(at.minCoeff() >= 0.0) || at.x() > cols_ || at.y() > rows_) return -1;
  const int col = std::min(cols_ - 1, static_cast<int>(at.x()));
  const int row = std::min(rows_ - 1, static_cast<int>(at.y()));
  return is_open(row, col) ? row * cols_ + col : -1;
}

/// Every cell that the straight line between the two centres touches is open.
bool RoughGround::may_move(int row, int col, int rows, int cols) const {
  if (!is_open(row + rows, col + cols)) return false;
  if (rows == 0 || cols == 0) return true;
  if (std::abs(rows) == 1 && std::abs(cols) == 1) return is_open(row + rows, col) && is_open(row, col + cols);
  if (std::abs(cols) == 2) return is_open(row, col + cols / 2) && is_open(row + rows, col + cols / 2);
  return is_open(row + rows / 2, col) && is_open(row + rows / 2, col + cols);
}

const std::vector<float>& RoughGround::distances_from(int cell) const {
  const auto [found, is_new] = distances_.try_emplace(cell);
  std::vector<float>& out = found->second;
  if (!is_new) return out;
  out.assign(open_.size(), std::numeric_limits<float>::infinity());
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  out[static_cast<std::size_t>(cell)] = 0.0F;
  open.emplace(0.0F, cell);
  while (!open.empty()) {
    const auto [distance, at] = open.top();
    open.pop();
    if (distance > out[static_cast<std::size_t>(at)]) continue;
    for (const Move& move : kMoves) {
      if (!may_move(at / cols_, at % cols_, move.rows, move.cols)) continue;
      const int to = at + move.rows * cols_ + move.cols;
      const float there = distance + length_of(move) * static_cast<float>(params_.cell_m);
      if (there >= out[static_cast<std::size_t>(to)]) continue;
      out[static_cast<std::size_t>(to)] = there;
      open.emplace(there, to);
    }
  }
  return out;
}

double RoughGround::drive_s(const Vec2& from, const Vec2& to) const {
  const int begin = cell_at(from);
  const int end = cell_at(to);
  if (begin < 0 || end < 0) return kInfinity;
  if (begin == end) return (to - from).norm() / params_.speed_mps;
  const std::lock_guard lock(mutex_);
  // From the lesser cell, so that both ways are the same way.
  const double between = distances_from(std::min(begin, end))[static_cast<std::size_t>(std::max(begin, end))];
  return ((from - centre(begin)).norm() + between + (to - centre(end)).norm()) / params_.speed_mps;
}

std::vector<Vec2> RoughGround::bends(const Vec2& from, const Vec2& to) const {
  const int begin = cell_at(from);
  const int end = cell_at(to);
  if (begin < 0 || end < 0 || begin == end) return {};
  const std::lock_guard lock(mutex_);
  const int source = std::min(begin, end);
  const std::vector<float>& distances = distances_from(source);
  int at = std::max(begin, end);
  if (!std::isfinite(distances[static_cast<std::size_t>(at)])) return {};
  std::vector<Vec2> out{centre(at)};
  while (at != source) {
    int before = at;
    for (const Move& move : kMoves) {
      if (!may_move(at / cols_, at % cols_, move.rows, move.cols)) continue;
      const int next = at + move.rows * cols_ + move.cols;
      const float there =
          distances[static_cast<std::size_t>(next)] + length_of(move) * static_cast<float>(params_.cell_m);
      if (there != distances[static_cast<std::size_t>(at)]) continue;
      before = next;
      break;
    }
    if (before == at) return {};
    at = before;
    out.push_back(centre(at));
  }
  if (source == begin) std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace swallowtail::coverage
