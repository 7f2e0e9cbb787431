#include "coverage/field/strips.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "coverage/field/detail/geos.hpp"
#include "coverage/field/sweep.hpp"
#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

constexpr int kMaxDepth = 6;
/// Parts smaller than this share of a sensor's square are not flown on their own.
constexpr double kLeastPart = 2e-4;

struct Interval {
  double from = 0.0;
  double to = 0.0;
};

/// A horizontal line to fly, in the turned frame.
struct Line {
  double from_x = 0.0;
  double to_x = 0.0;
  double y = 0.0;
};

void add_crossings(const Ring& ring, double y, std::vector<double>& xs) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2& a = ring[i];
    const Vec2& b = ring[(i + 1) % ring.size()];
    if ((a.y() > y) != (b.y() > y)) xs.push_back(a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()));
  }
}

/// Where the line at y runs within the part, in order.
std::vector<Interval> intervals_at(const Polygon& part, double y) {
  std::vector<double> xs;
  add_crossings(part.outline, y, xs);
  for (const Ring& hole : part.holes) add_crossings(hole, y, xs);
  std::sort(xs.begin(), xs.end());
  std::vector<Interval> out;
  for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
    if (xs[i + 1] > xs[i]) out.push_back({xs[i], xs[i + 1]});
  }
  return out;
}

/// Finds the lines that cover one field; everything in the frame in which strips run along x.
class StripCutter {
 public:
  StripCutter(const Polygon& field, double sensor_width_m) : field_(field), width_m_(sensor_width_m) {}

  Status cover(const Polygon& part, double y, int depth);
  std::vector<Line> take_lines() { return std::exchange(lines_, {}); }

 private:
  bool is_hole(double x, double y) const {
    return std::any_of(field_.holes.begin(), field_.holes.end(),
                       [&](const Ring& hole) { return contains(hole, Vec2(x, y)); });
  }
  bool may_cross(const Interval& gap, double y) const {
    return gap.to - gap.from <= width_m_ / 2.0 && !is_hole((gap.from + gap.to) / 2.0, y);
  }
  /// Whether a line may be prolonged over the gap at a part's end: along a slanted border always, over a hole
  /// by no more than a sensor width.
  bool may_prolong(const Interval& gap, double y) const {
    return gap.to - gap.from <= width_m_ || !is_hole((gap.from + gap.to) / 2.0, y);
  }
  Status cover_gap(const Polygon& part, const Interval& gap, int depth, Line* before, Line* after);
  Status cover_alone(const Polygon& part, int depth) {
    const Box box = bounds_of(part.outline);
    return cover(part, (box.lo.y() + box.hi.y()) / 2.0, depth);
  }

  const Polygon& field_;
  double width_m_;
  std::vector<Line> lines_;
};

Status StripCutter::cover(const Polygon& part, double y, int depth) {
  if (area_m2(part) < kLeastPart * width_m_ * width_m_) return {};
  const Box box = bounds_of(part.outline);
  std::vector<Interval> inside;
  for (const Interval& interval : intervals_at(part, y)) {
    if (!inside.empty() && may_cross({inside.back().to, interval.from}, y)) {
      inside.back().to = interval.to;
    } else {
      inside.push_back(interval);
    }
  }
  const bool gives_up = depth >= kMaxDepth;
  if (inside.empty() && depth == 0) return cover_alone(part, depth + 1);
  if (inside.empty() || gives_up) {
    lines_.push_back({box.lo.x(), box.hi.x(), y});
    return {};
  }
  std::vector<Line> lines;
  for (const Interval& interval : inside) lines.push_back({interval.from, interval.to, y});
  if (const Status s = cover_gap(part, {box.lo.x(), inside.front().from}, depth, nullptr, &lines.front()); !s)
    return s;
  for (std::size_t i = 0; i + 1 < inside.size(); ++i) {
    if (const Status s = cover_gap(part, {inside[i].to, inside[i + 1].from}, depth, &lines[i], &lines[i + 1]);
        !s)
      return s;
  }
  if (const Status s = cover_gap(part, {inside.back().to, box.hi.x()}, depth, &lines.back(), nullptr); !s)
    return s;
  lines_.insert(lines_.end(), lines.begin(), lines.end());
  return {};
}

/// What of the part lies beside a gap of its centre line: the neighbouring lines are prolonged over what
/// hangs on one of them, the rest gets its own.
Status StripCutter::cover_gap(const Polygon& part, const Interval& gap, int depth, Line* before,
                              Line* after) {
  const double y = before != nullptr ? before->y : after->y;
  const bool at_end = before == nullptr || after == nullptr;
  if (gap.to - gap.from < 1e-9) return {};
  if (at_end && may_prolong(gap, y)) {
    if (before != nullptr) before->to_x = gap.to;
    if (after != nullptr) after->from_x = gap.from;
    return {};
  }
  const Box box = bounds_of(part.outline);
  auto beside = detail::clip(part, {{gap.from, box.lo.y() - 1.0}, {gap.to, box.hi.y() + 1.0}});
  if (!beside) return beside.error();
  for (const Polygon& rest : *beside) {
    if (area_m2(rest) < kLeastPart * width_m_ * width_m_) continue;
    const Box extent = bounds_of(rest.outline);
    const bool hangs_before =
        before != nullptr && extent.lo.x() <= gap.from + 1e-6 && extent.hi.x() - gap.from <= width_m_;
    const bool hangs_after =
        after != nullptr && extent.hi.x() >= gap.to - 1e-6 && gap.to - extent.lo.x() <= width_m_;
    const bool joins = hangs_before && hangs_after && before != nullptr && after != nullptr;
    if (hangs_before && !joins) {
      before->to_x = std::max(before->to_x, extent.hi.x());
    } else if (hangs_after && !joins) {
      after->from_x = std::min(after->from_x, extent.lo.x());
    } else if (const Status s = cover_alone(rest, depth + 1); !s) {
      return s;
    }
  }
  return {};
}

}  // namespace

Status validate(const StripParams& params) {
  if (!is_positive(params.sensor_width_m))
    return bad_input("The sensor width must be a positive number of metres.");
  if (params.sweep_rad && !is_finite(*params.sweep_rad))
    return bad_input("The sweep direction must be finite.");
  if (!is_non_negative(params.piece_cost_m)) return bad_input("The cost of a piece must not be negative.");
  return {};
}

Result<Strips> cut_strips(const Polygon& polygon, const StripParams& params) {
  if (const Status status = validate(params); !status) return status.error();
  Strips out;
  const Box raw = bounds_of(polygon.outline);
  if ((raw.hi - raw.lo).norm() / params.sensor_width_m > 4.0 * kMaxStrips) {
    return bad_input("The field is " + std::to_string((raw.hi - raw.lo).norm()) +
                     " m across: too large for a sensor of " + std::to_string(params.sensor_width_m) + " m.");
  }
  out.sweep_rad = params.sweep_rad ? *params.sweep_rad
                                   : best_sweep_rad(polygon, {params.sensor_width_m, params.piece_cost_m});
  const Polygon turned = rotated(polygon, -out.sweep_rad);
  const Box box = bounds_of(turned.outline);
  const double extent = box.hi.y() - box.lo.y();
  out.count = strip_count(extent, params.sensor_width_m);
  if (out.count > kMaxStrips) {
    return bad_input("The field needs " + std::to_string(out.count) + " strips; at most 4096 are planned.");
  }
  out.width_m = extent / out.count;
  const detail::Clipper clipper(turned);
  StripCutter cutter(turned, params.sensor_width_m);
  for (int s = 0; s < out.count; ++s) {
    const double low = box.lo.y() + s * out.width_m;
    auto parts = clipper.clip({{box.lo.x() - 1.0, low}, {box.hi.x() + 1.0, low + out.width_m}});
    if (!parts) return parts.error();
    for (const Polygon& part : *parts) {
      if (const Status status = cutter.cover(part, low + out.width_m / 2.0, 0); !status)
        return status.error();
    }
    std::vector<Line> lines = cutter.take_lines();
    std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
      return a.from_x != b.from_x ? a.from_x < b.from_x : a.y < b.y;
    });
    for (const Line& line : lines) {
      out.pieces.push_back({rotated(Vec2(line.from_x, line.y), out.sweep_rad),
                            rotated(Vec2(line.to_x, line.y), out.sweep_rad), s});
    }
  }
  return out;
}

}  // namespace swallowtail::coverage
