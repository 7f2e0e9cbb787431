#include "tests/support/cover_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swallowtail::test_support {
namespace {

/// Where a horizontal line meets the rings, in order.
std::vector<double> meets(const Ground& ground, double y) {
  std::vector<double> out;
  for (const auto& ring : ground.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto& [ax, ay] = ring[i];
      const auto& [bx, by] = ring[(i + 1) % ring.size()];
      if ((ay <= y) == (by <= y)) continue;
      out.push_back(ax + (y - ay) / (by - ay) * (bx - ax));
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

struct Raster {
  double x0 = 0.0;
  double y0 = 0.0;
  double cell = 1.0;
  long cols = 0;
  long rows = 0;
  std::vector<char> state;  // 0 elsewhere, 1 asked for, 2 seen

  double x(long c) const { return x0 + (static_cast<double>(c) + 0.5) * cell; }
  double y(long r) const { return y0 + (static_cast<double>(r) + 0.5) * cell; }
  char& at(long r, long c) { return state[static_cast<std::size_t>(r * cols + c)]; }
  long col_from(double px) const {
    return std::max(0L, static_cast<long>(std::ceil((px - x0) / cell - 0.5)));
  }
  long row_from(double py) const {
    return std::max(0L, static_cast<long>(std::ceil((py - y0) / cell - 0.5)));
  }
};

Raster raster_of(const Ground& ground, double cell) {
  double x1 = -std::numeric_limits<double>::infinity();
  double y1 = x1;
  Raster out;
  out.x0 = -x1;
  out.y0 = -x1;
  out.cell = cell;
  for (const auto& ring : ground.rings) {
    for (const auto& [x, y] : ring) {
      out.x0 = std::min(out.x0, x);
      out.y0 = std::min(out.y0, y);
      x1 = std::max(x1, x);
      y1 = std::max(y1, y);
    }
  }
  out.cols = static_cast<long>(std::ceil((x1 - out.x0) / cell));
  out.rows = static_cast<long>(std::ceil((y1 - out.y0) / cell));
  out.state.assign(static_cast<std::size_t>(out.cols * out.rows), 0);
  for (long r = 0; r < out.rows; ++r) {
    const std::vector<double> xs = meets(ground, out.y(r));
    for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
      for (long c = out.col_from(xs[i]); c < out.cols && out.x(c) < xs[i + 1]; ++c) out.at(r, c) = 1;
    }
  }
  return out;
}

/// Marks the cells whose centres lie in the rectangle seen from a line.
void see(Raster& raster, const FlownLine& line, double width) {
  const double dx = line.to.first - line.from.first;
  const double dy = line.to.second - line.from.second;
  const double length = std::hypot(dx, dy);
  if (length < 1e-9) return;
  const double ux = dx / length;
  const double uy = dy / length;
  const double half = width / 2.0 + 1e-6;
  const double slack = 2e-3;
  const double reach_y = std::abs(uy) * slack + std::abs(ux) * half;
  const double low = std::min(line.from.second, line.to.second) - reach_y;
  const double high = std::max(line.from.second, line.to.second) + reach_y;
  const double reach_x = std::abs(ux) * slack + std::abs(uy) * half;
  const double left = std::min(line.from.first, line.to.first) - reach_x;
  const double right = std::max(line.from.first, line.to.first) + reach_x;
  for (long r = raster.row_from(low); r < raster.rows && raster.y(r) <= high; ++r) {
    for (long c = raster.col_from(left); c < raster.cols && raster.x(c) <= right; ++c) {
      char& state = raster.at(r, c);
      if (state != 1) continue;
      const double px = raster.x(c) - line.from.first;
      const double py = raster.y(r) - line.from.second;
      const double along = px * ux + py * uy;
      const double across = px * uy - py * ux;
      if (std::abs(across) <= half && along >= -slack && along <= length + slack) state = 2;
    }
  }
}

}  // namespace

bool is_on(const Ground& ground, const Point& point) {
  const std::vector<double> xs = meets(ground, point.second);
  const auto past = std::upper_bound(xs.begin(), xs.end(), point.first);
  return (past - xs.begin()) % 2 == 1;
}

double distance_to_border(const Ground& ground, const Point& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& ring : ground.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto& [ax, ay] = ring[i];
      const auto& [bx, by] = ring[(i + 1) % ring.size()];
      const double dx = bx - ax;
      const double dy = by - ay;
      const double square = dx * dx + dy * dy;
      double t = square > 0.0 ? ((point.first - ax) * dx + (point.second - ay) * dy) / square : 0.0;
      t = std::clamp(t, 0.0, 1.0);
      least = std::min(least, std::hypot(point.first - ax - t * dx, point.second - ay - t * dy));
    }
  }
  return least;
}

CoverVerdict judge_cover(const Ground& ground, const std::vector<FlownLine>& lines,
                         const CoverQuestion& question) {
  CoverVerdict out;
  Raster raster = raster_of(ground, question.cell_m);
  for (const FlownLine& line : lines) see(raster, line, question.width_m);
  const long seen = std::count(raster.state.begin(), raster.state.end(), static_cast<char>(2));
  out.points = seen + std::count(raster.state.begin(), raster.state.end(), static_cast<char>(1));
  out.covered_share = out.points > 0 ? static_cast<double>(seen) / static_cast<double>(out.points) : 0.0;
  for (const FlownLine& line : lines) {
    const double length = std::hypot(line.to.first - line.from.first, line.to.second - line.from.second);
    const int steps = std::max(1, static_cast<int>(std::ceil(length / question.step_m)));
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      const Point p{line.from.first + t * (line.to.first - line.from.first),
                    line.from.second + t * (line.to.second - line.from.second)};
      if (is_on(ground, p) || distance_to_border(ground, p) <= question.tolerance_m) continue;
      if (out.outside_m == 0.0) out.first_outside = p;
      out.outside_m += length / steps;
    }
  }
  return out;
}

}  // namespace swallowtail::test_support
