#include "coverage/field/detail/trim.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

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

/// What all pieces see at one width; of those gone nothing.
struct Bands {
  double width_m = 0.0;
  std::vector<Ring> seen;
};

/// What of a piece cannot be done without.
struct Need {
  Interval along{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  double dropped_m2 = 0.0;

  bool is_none() const { return along.to < along.from; }
};

/// What others see of what a piece may see.
std::vector<Ring> seen_by_others(const Bands& bands, std::size_t piece) {
  std::vector<Ring> out;
  for (std::size_t j = 0; j < bands.seen.size(); ++j) {
    const Ring& other = bands.seen[j];
    if (j != piece && !other.empty() && may_meet(bands.seen[piece], other)) out.push_back(other);
  }
  return out;
}

/// Adds what is needed on account of parts that the piece alone sees; `allowed_m2` of them may be dropped.
void add_need(const Shape& alone, const Line& line, double width_m, double allowed_m2, Need& need) {
  for (const Polygon& part : alone.parts()) {
    const double area = area_m2(part);
    if (area < kLeastPart * width_m * width_m && need.dropped_m2 + area <= allowed_m2) {
      need.dropped_m2 += area;
      continue;
    }
    for (const Vec2& p : part.outline) {
      need.along.from = std::min(need.along.from, line.along_of(p));
      need.along.to = std::max(need.along.to, line.along_of(p));
    }
  }
}

/// Nothing when no other piece is near, or GEOS failed.
std::optional<Need> need_of(const std::vector<Bands>& bands, std::size_t piece, const Line& line,
                            const Shape& field, double allowed_m2) {
  std::vector<Shape> alone;
  double alone_m2 = 0.0;
  for (const Bands& band : bands) {
    const std::vector<Ring> others = seen_by_others(band, piece);
    if (others.empty() && alone.empty()) return std::nullopt;
    alone.push_back(Shape::of(Polygon{band.seen[piece], {}}).within(field));
    if (!others.empty()) alone.back() = alone.back().minus(Shape::of(others));
    if (!alone.back().ok()) return std::nullopt;
    alone_m2 += alone.back().area_m2();
  }
  Need out;
  if (alone_m2 <= allowed_m2) {
    out.dropped_m2 = alone_m2;
    return out;
  }
  for (std::size_t b = 0; b < bands.size(); ++b) add_need(alone[b], line, bands[b].width_m, allowed_m2, out);
  return out;
}

}  // namespace

double trim(const Polygon& polygon, const TrimParams& params, std::vector<Segment>& pieces) {
  const Shape field = Shape::of(polygon);
  std::vector<Bands> bands{{params.width_m, {}}};
  if (params.near_m < params.width_m) bands.push_back({params.near_m, {}});
  for (Bands& band : bands) {
    for (const Segment& piece : pieces) band.seen.push_back(seen_from(piece, band.width_m));
  }
  std::vector<std::size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return pieces[a].length_m() < pieces[b].length_m(); });
  std::vector<char> gone(pieces.size(), 0);
  double lost_m2 = 0.0;
  for (const std::size_t i : order) {
    const Line line = line_through(pieces[i].from_m, pieces[i].to_m);
    const std::optional<Need> need = need_of(bands, i, line, field, params.allowed_m2 - lost_m2);
    if (!need) continue;
    if (need->is_none()) {
      gone[i] = 1;
      lost_m2 += need->dropped_m2;
      for (Bands& band : bands) band.seen[i].clear();
      continue;
    }
    const Interval needed{std::max(need->along.from, 0.0), std::min(need->along.to, pieces[i].length_m())};
    if (needed.to - needed.from > pieces[i].length_m() - kLeastGain_m || needed.to - needed.from < kInside_m)
      continue;
    lost_m2 += need->dropped_m2;
    pieces[i] = line.piece(needed, pieces[i].strip);
    for (Bands& band : bands) band.seen[i] = seen_from(pieces[i], band.width_m);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (gone[i] == 0) pieces[kept++] = pieces[i];
  }
  pieces.resize(kept);
  return lost_m2;
}

}  // namespace swallowtail::coverage::detail
