#include "coverage/field/detail/line_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coverage/field/detail/simplify.hpp"

namespace swallowtail::coverage::detail {
namespace {

/// Borders are taken as straight where they deviate by no more than this share of the width.
constexpr double kStraight = 0.24;
constexpr double kShortest_m = 0.02;
/// Distances from a border at which it is flown along, of which one is tried at a time.
constexpr std::size_t kOffsets = 3;
constexpr std::size_t kDirections = 2;
/// Lines side by side in one direction, from either end.
constexpr int kMostBeside = 12;
/// How much better a candidate may look by chance.
constexpr double kNoise = 0.35;
constexpr double kBetter_m = 1e-6;
constexpr double kFar = std::numeric_limits<double>::infinity();

}  // namespace

CandidateLines::CandidateLines(const Polygon& polygon, double width_m)
    : rings_(rings_of(polygon)), width_m_(width_m) {
  add_borders(polygon.outline);
  for (const Ring& hole : polygon.holes) add_borders(hole);
}

/// Beside each straight stretch of border: as far from it as it is still seen, as near as the line stays
/// inside, and between.
void CandidateLines::add_borders(const Ring& ring) {
  const std::vector<std::size_t> corners = corners_of(ring, kStraight * width_m_);
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const Vec2& a = ring[corners[k] % ring.size()];
    const Vec2& b = ring[corners[k + 1] % ring.size()];
    const double length = (b - a).norm();
    if (length < kShortest_m) continue;
    const Line border = line_through(a, b);
    Interval depth{0.0, 0.0};
    for (std::size_t i = corners[k]; i <= corners[k + 1]; ++i) {
      const double left = border.left_of(ring[i % ring.size()]);
      depth = {std::min(depth.from, left), std::max(depth.to, left)};
    }
    const Vec2 inwards(-border.along.y(), border.along.x());
    const double farthest = width_m_ / 2.0 + depth.from - kInside_m;
    const double nearest = std::min(depth.to + kInside_m, farthest);
    for (const double offset : {farthest, (nearest + farthest) / 2.0, nearest}) {
      const Line line{border.origin_m + inwards * offset, border.along};
      borders_.push_back({line, inside_of(rings_, line)});
    }
  }
}

void CandidateLines::add_stretches(const Stretches& stretches, const OpenGround& open,
                                   std::vector<Candidate>& out) const {
  const Band whole{stretches.line, {-kFar, kFar}, width_m_ / 2.0};
  if (!open.may_meet(whole)) return;
  for (const Interval& inside : stretches.inside) {
    if (!open.may_meet({stretches.line, inside, width_m_ / 2.0})) continue;
    const double most_m2 = open.area_near({stretches.line, inside, width_m_ / 2.0});
    if (most_m2 <= 0.0) continue;
    out.push_back({stretches.line, inside, nullptr, most_m2, 1.0, {stretches.line, inside, width_m_}});
  }
}

void CandidateLines::add_line(const Line& line, const OpenGround& open, std::vector<Candidate>& out) const {
  add_stretches({line, inside_of(rings_, line)}, open, out);
}

/// Side by side from either end of what is open.
void CandidateLines::add_direction(const Vec2& along, const OpenGround& open,
                                   std::vector<Candidate>& out) const {
  const Vec2 left(-along.y(), along.x());
  Interval across{kFar, -kFar};
  for (const Patch& patch : open.patches()) {
    for (std::size_t i = 0; i < patch.size; ++i) {
      const double at = left.dot(patch.corners[i]);
      across = {std::min(across.from, at), std::max(across.to, at)};
    }
  }
  const double step = width_m_ - 2.0 * kInside_m;
  const int count = std::clamp(static_cast<int>(std::ceil((across.to - across.from) / step)), 1, kMostBeside);
  for (int i = 0; i < count; ++i) {
    add_line({left * (across.from + (i + 0.5) * step), along}, open, out);
    if (count > 1) add_line({left * (across.to - (i + 0.5) * step), along}, open, out);
  }
}

Candidate CandidateLines::drawn_on(const PiecePtr& base, const Interval& limits) const {
  return {base->band.line, limits, base, 0.0, 1.0, {base->band.line, limits, width_m_}};
}

/// A line that grazes a corner may come out as two: neither is the piece drawn on.
void CandidateLines::add_drawn_on(const PiecePtr& piece, std::vector<Candidate>& out) const {
  const double length = piece->segment.length_m();
  for (const Interval& inside : inside_of(rings_, piece->band.line)) {
    if (inside.from > kBetter_m || inside.to < length - kBetter_m) continue;
    out.push_back(drawn_on(piece, {std::min(inside.from, 0.0), std::max(inside.to, length)}));
  }
}

std::vector<Candidate> CandidateLines::around(const OpenGround& open, const std::vector<PiecePtr>& taken,
                                              const std::vector<PiecePtr>& kept, Rng& rng) const {
  std::vector<Candidate> out;
  for (std::size_t i = 0; i < borders_.size(); i += kOffsets)
    add_stretches(borders_[i + rng.below(kOffsets)], open, out);
  std::vector<Vec2> directions;
  for (const PiecePtr& piece : taken) {
    add_line(piece->band.line, open, out);
    directions.push_back(piece->band.line.along);
  }
  for (const PiecePtr& piece : kept) {
    const bool near =
        std::any_of(taken.begin(), taken.end(), [&](const PiecePtr& other) { return meet(*piece, *other); });
    if (!near) continue;
    directions.push_back(piece->band.line.along);
    add_drawn_on(piece, out);
  }
  for (std::size_t i = 0; i < kDirections; ++i)
    add_direction(directions[rng.below(directions.size())], open, out);
  for (Candidate& candidate : out) candidate.noise = 1.0 + kNoise * rng.uniform();
  return out;
}

}  // namespace swallowtail::coverage::detail
