#include "coverage/field/detail/trim.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "coverage/field/detail/geos.hpp"

namespace swallowtail::coverage::detail {
namespace {

/// Shortening by less is not worth it.
constexpr double kLeastGain_m = 0.2;
/// Parts that a piece alone sees count when they are larger than this share of the width's square.
constexpr double kLeastPart = 1e-4;

bool may_meet(const Ring& a, const Ring& b) {
  const Box p = bounds_of(a);
  const Box q = bounds_of(b);
  return (p.lo.array() < q.hi.array()).all() && (q.lo.array() < p.hi.array()).all();
}

}  // namespace

double trim(const Polygon& polygon, const TrimParams& params, std::vector<Segment>& pieces) {
  const Shape field = Shape::of(polygon);
  std::vector<Ring> seen;
  for (const Segment& piece : pieces) seen.push_back(seen_from(piece, params.width_m));
  std::vector<std::size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return pieces[a].length_m() < pieces[b].length_m(); });
  std::vector<char> gone(pieces.size(), 0);
  double lost_m2 = 0.0;
  for (const std::size_t i : order) {
    std::vector<Ring> others;
    for (std::size_t j = 0; j < pieces.size(); ++j) {
      if (j != i && gone[j] == 0 && may_meet(seen[i], seen[j])) others.push_back(seen[j]);
    }
    if (others.empty()) continue;
    const Shape alone = Shape::of(Polygon{seen[i], {}}).within(field).minus(Shape::of(others));
    if (!alone.ok()) continue;
    const Line line = line_through(pieces[i].from_m, pieces[i].to_m);
    Interval needed{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    double dropped_m2 = 0.0;
    const bool all_gone = lost_m2 + alone.area_m2() <= params.allowed_m2;
    for (const Polygon& part : alone.parts()) {
      const double area = area_m2(part);
      if (all_gone || (area < kLeastPart * params.width_m * params.width_m &&
                       lost_m2 + dropped_m2 + area <= params.allowed_m2)) {
        dropped_m2 += area;
        continue;
      }
      for (const Vec2& p : part.outline) {
        needed.from = std::min(needed.from, line.along_of(p));
        needed.to = std::max(needed.to, line.along_of(p));
      }
    }
    if (needed.to < needed.from) {
      gone[i] = 1;
      lost_m2 += dropped_m2;
      continue;
    }
    needed.from = std::max(needed.from, 0.0);
    needed.to = std::min(needed.to, pieces[i].length_m());
    if (needed.to - needed.from > pieces[i].length_m() - kLeastGain_m || needed.to - needed.from < kInside_m)
      continue;
    lost_m2 += dropped_m2;
    pieces[i] = line.piece(needed, pieces[i].strip);
    seen[i] = seen_from(pieces[i], params.width_m);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (gone[i] == 0) pieces[kept++] = pieces[i];
  }
  pieces.resize(kept);
  return lost_m2;
}

}  // namespace swallowtail::coverage::detail
