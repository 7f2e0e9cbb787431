#include "coverage/field/strips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "coverage/field/detail/geos.hpp"
#include "coverage/field/detail/line_search.hpp"
#include "coverage/field/detail/lines.hpp"
#include "coverage/field/detail/rest.hpp"
#include "coverage/field/detail/simplify.hpp"
#include "coverage/field/detail/trim.hpp"
#include "coverage/field/sweep.hpp"
#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

/// Part of kUncoveredShare that lines along borders may leave, the rest is for drawing pieces in.
constexpr double kRestShare = 0.7;
/// Sweep directions that are cut and compared.
constexpr std::size_t kSweepsTried = 3;
constexpr double kBetter_m = 1e-6;
/// Rounds of the line search for each piece, and at most; between holes there is more to be had.
struct Rounds {
  int per_piece;
  int most;
};
constexpr Rounds kRounds{10, 300};
constexpr int kLeastRounds = 40;
constexpr Rounds kRoundsAmongHoles{40, 1500};
/// Of what a piece costs by itself, what it costs in a tour: not every turn is sharp enough for a stop.
constexpr double kInTour = 0.7;
/// Pieces of a field beyond which the search would be a drop in the ocean.
constexpr std::size_t kMostSearched = 1000;

double spacing_m(const StripParams& params) { return params.sensor_width_m * (1.0 - params.overlap); }

/// Strips in the frame in which they run along x.
struct Cut {
  int count = 0;
  double width_m = 0.0;
  std::vector<detail::Segment> pieces;
};

/// Lines along the border: rings inside it, their straight stretches prolonged into the corners.
void add_headland(const Polygon& turned, const StripParams& params, Cut& out) {
  const int rounds = strip_count(params.headland_m, spacing_m(params));
  const detail::Shape field = detail::Shape::of(turned);
  for (int r = 0; r < rounds; ++r) {
    const double depth = params.headland_m * (r + 0.5) / rounds;
    const auto add_ring = [&](const Ring& ring) {
      const std::vector<std::size_t> corners = detail::corners_of(ring, depth / 2.0);
      for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
        const Vec2& a = ring[corners[k]];
        const Vec2& b = ring[corners[k + 1] % ring.size()];
        const double length = (b - a).norm();
        if (length < 2.0 * detail::kInside_m) continue;
        const detail::Line line = detail::line_through(a, b);
        for (const detail::Interval& inside : detail::inside_of(turned, line)) {
          if (inside.from > length / 2.0 || inside.to < length / 2.0) continue;
          out.pieces.push_back(
              line.piece({std::max(inside.from, -depth), std::min(inside.to, length + depth)}));
        }
      }
    };
    for (const Polygon& part : field.inset(depth).parts()) {
      add_ring(part.outline);
      for (const Ring& hole : part.holes) add_ring(hole);
    }
  }
}

/// What is prolonged: a polygon, also as a shape, and where its lines may not go. In the frame of the lines.
struct Ground {
  const Polygon& polygon;
  const detail::Shape& shape;
  const std::vector<Polygon>& closed;
};

/// Over a slanted border a line is prolonged until half a sensor sideways sees what hangs on it.
void prolong(const Ground& ground, double y, double width_m, std::vector<detail::Interval>& lines) {
  const Box box = bounds_of(ground.polygon.outline);
  const detail::Line line{Vec2(0.0, y), Vec2(1.0, 0.0)};
  const auto is_closed = [&](double from, double to) {
    return std::any_of(ground.closed.begin(), ground.closed.end(), [&](const Polygon& closed) {
      const auto inside = detail::inside_of(closed, line);
      return std::any_of(inside.begin(), inside.end(),
                         [&](const detail::Interval& i) { return i.from < to && i.to > from; });
    });
  };
  const Box slab{{box.lo.x() - 1.0, y - width_m / 2.0}, {box.hi.x() + 1.0, y + width_m / 2.0}};
  for (const Polygon& part : ground.shape.within(slab).parts()) {
    const Box extent = bounds_of(part.outline);
    detail::Interval* first = nullptr;
    detail::Interval* last = nullptr;
    for (detail::Interval& i : lines) {
      if (!contains(part, Vec2((i.from + i.to) / 2.0, y))) continue;
      if (first == nullptr) first = &i;
      last = &i;
    }
    if (first == nullptr) continue;
    if (!is_closed(extent.lo.x(), first->from)) first->from = std::min(first->from, extent.lo.x());
    if (!is_closed(last->to, extent.hi.x())) last->to = std::max(last->to, extent.hi.x());
  }
}

/// The centre lines of the strips of an area, where they run inside it.
Status add_lines(const Polygon& area, const StripParams& params, const std::vector<Polygon>& closed,
                 Cut& out) {
  const Box box = bounds_of(area.outline);
  const double extent = box.hi.y() - box.lo.y();
  const int count = strip_count(extent, spacing_m(params));
  if (out.count + count > kMaxStrips) {
    return bad_input("The field needs " + std::to_string(out.count + count) +
                     " strips; at most 4096 are planned.");
  }
  out.width_m = extent / count;
  const bool prolongs = params.beyond == Beyond::kSlantedBorders;
  const detail::Shape shape = prolongs ? detail::Shape::of(area) : detail::Shape();
  for (int s = 0; s < count; ++s) {
    const double y = box.lo.y() + (s + 0.5) * out.width_m;
    const detail::Line line{Vec2(0.0, y), Vec2(1.0, 0.0)};
    std::vector<detail::Interval> inside = detail::inside_of(area, line);
    if (prolongs) prolong({area, shape, closed}, y, out.width_m, inside);
    for (const detail::Interval& i : inside) out.pieces.push_back(line.piece(i, out.count + s));
  }
  out.count += count;
  return {};
}

/// Lines that together see the field, none drawn in yet.
struct Lines {
  double turn_rad = 0.0;
  Polygon turned;  ///< in the frame of the lines
  Cut cut;
  double uncovered_m2 = 0.0;
  double allowed_m2 = 0.0;  ///< may become uncovered besides

  /// Metres of flight with piece_cost_m for each piece.
  double cost_m(double piece_cost_m) const {
    double cost = 0.0;
    for (const detail::Segment& piece : cut.pieces) cost += piece.length_m() + piece_cost_m;
    return cost;
  }
};

/// What the lines leave over gets lines of its own.
Status add_rest(const StripParams& params, Lines& lines) {
  std::vector<Ring> seen;
  for (const detail::Segment& piece : lines.cut.pieces)
    seen.push_back(detail::seen_from(piece, params.sensor_width_m));
  const detail::Shape rest = detail::Shape::of(lines.turned).minus(detail::Shape::of(seen));
  if (!rest.ok()) return internal_error("GEOS could not subtract the strips from the field.");
  const double allowed_m2 = kUncoveredShare * area_m2(lines.turned);
  detail::RestCover cover = detail::cover_rest(
      lines.turned, rest, {params.sensor_width_m, params.piece_cost_m, kRestShare * allowed_m2});
  int number = lines.cut.count;
  for (detail::Segment& piece : lines.cut.pieces) {
    if (piece.strip < 0) piece.strip = number++;
  }
  for (detail::Segment piece : cover.pieces) {
    piece.strip = number++;
    lines.cut.pieces.push_back(piece);
  }
  lines.uncovered_m2 = cover.uncovered_m2;
  lines.allowed_m2 = std::max(0.0, allowed_m2 - cover.uncovered_m2);
  return {};
}

/// Where no line goes that leaves the polygon, in its frame.
std::vector<Polygon> closed_to(const Polygon& turned, const StripParams& params, double sweep_rad) {
  std::vector<Polygon> out;
  if (params.beyond == Beyond::kNever) return out;
  for (const Ring& hole : turned.holes) out.push_back({hole, {}});
  for (const Polygon& closed : params.closed) out.push_back(rotated(closed, -sweep_rad));
  return out;
}

Result<Lines> lines_along(const Polygon& polygon, const StripParams& params, double sweep_rad) {
  Lines out{sweep_rad, rotated(polygon, -sweep_rad), {}};
  const std::vector<Polygon> closed = closed_to(out.turned, params, sweep_rad);
  if (params.headland_m > 0.0) {
    add_headland(out.turned, params, out.cut);
    for (const Polygon& part : detail::Shape::of(out.turned).inset(params.headland_m).parts()) {
      if (const Status status = add_lines(part, params, closed, out.cut); !status) return status.error();
    }
  } else if (const Status status = add_lines(out.turned, params, closed, out.cut); !status) {
    return status.error();
  }
  if (const Status status = add_rest(params, out); !status) return status.error();
  return out;
}

Strips strips_of(const Lines& lines) {
  Strips out{lines.turn_rad, lines.cut.count, lines.cut.width_m, {}, lines.uncovered_m2};
  for (const detail::Segment& piece : lines.cut.pieces)
    out.pieces.push_back(
        {rotated(piece.from_m, lines.turn_rad), rotated(piece.to_m, lines.turn_rad), piece.strip});
  return out;
}

Strips drawn_in(const StripParams& params, Lines lines) {
  // Where lines are to overlap, each is needed for what lies nearest to it, though others see that too.
  const detail::TrimParams trim{params.sensor_width_m, spacing_m(params), lines.allowed_m2};
  lines.uncovered_m2 += detail::trim(lines.turned, trim, lines.cut.pieces);
  std::stable_sort(lines.cut.pieces.begin(), lines.cut.pieces.end(),
                   [](const detail::Segment& a, const detail::Segment& b) { return a.strip < b.strip; });
  return strips_of(lines);
}

bool is_mixed(const StripParams& params, const Lines& lines) {
  return params.headland_m <= 0.0 && params.overlap <= 0.0 && params.beyond == Beyond::kNever &&
         lines.cut.pieces.size() <= kMostSearched;
}

/// Lines of any direction, each where it pays, in the order of a tour.
Strips mixed(const StripParams& params, Lines lines) {
  std::vector<detail::Segment>& pieces = lines.cut.pieces;
  detail::LineSearchParams search;
  search.width_m = params.sensor_width_m;
  search.piece_cost_m = kInTour * params.piece_cost_m;
  search.turn = params.turn;
  search.allowed_m2 = lines.allowed_m2;
  const Rounds& rounds = lines.turned.holes.empty() ? kRounds : kRoundsAmongHoles;
  search.rounds = std::clamp(rounds.per_piece * static_cast<int>(pieces.size()), kLeastRounds, rounds.most);
  lines.uncovered_m2 += detail::search_lines(lines.turned, search, pieces);
  int number = 0;
  for (const detail::Segment& piece : pieces) number = std::max(number, piece.strip + 1);
  for (detail::Segment& piece : pieces) {
    if (piece.strip < 0) piece.strip = number++;
  }
  return strips_of(lines);
}

}  // namespace

Status validate(const StripParams& params) {
  if (!is_positive(params.sensor_width_m))
    return bad_input("The sensor width must be a positive number of metres.");
  if (!is_within(params.overlap, 0.0, 0.9))
    return bad_input("The overlap must be a share from 0 to 0.9 of the sensor's width.");
  if (params.sweep_rad && !is_finite(*params.sweep_rad))
    return bad_input("The sweep direction must be finite.");
  if (!is_non_negative(params.piece_cost_m)) return bad_input("The cost of a piece must not be negative.");
  if (!is_non_negative(params.headland_m)) return bad_input("The headland must not be negative.");
  return {};
}

Result<Strips> cut_strips(const Polygon& polygon, const StripParams& params) {
  if (const Status status = validate(params); !status) return status.error();
  const Box raw = bounds_of(polygon.outline);
  if ((raw.hi - raw.lo).norm() / params.sensor_width_m > 4.0 * kMaxStrips) {
    return bad_input("The field is " + std::to_string((raw.hi - raw.lo).norm()) +
                     " m across: too large for a sensor of " + std::to_string(params.sensor_width_m) + " m.");
  }
  if (params.sweep_rad) {
    Result<Lines> lines = lines_along(polygon, params, *params.sweep_rad);
    if (!lines) return lines.error();
    return drawn_in(params, std::move(*lines));
  }
  const SweepParams sweep{params.sensor_width_m, spacing_m(params), params.piece_cost_m};
  std::optional<Result<Lines>> best;
  double least_m = std::numeric_limits<double>::infinity();
  for (const double angle_rad : best_sweeps_rad(polygon, sweep, kSweepsTried)) {
    Result<Lines> lines = lines_along(polygon, params, angle_rad);
    const double cost_m =
        lines ? lines->cost_m(params.piece_cost_m) : std::numeric_limits<double>::infinity();
    if (best && cost_m >= least_m - kBetter_m) continue;
    least_m = cost_m;
    best = std::move(lines);
  }
  if (!best->ok()) return best->error();
  Lines& lines = best->value();
  return is_mixed(params, lines) ? mixed(params, std::move(lines)) : drawn_in(params, std::move(lines));
}

}  // namespace swallowtail::coverage
