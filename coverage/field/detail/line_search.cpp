#include "coverage/field/detail/line_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "coverage/field/detail/line_gain.hpp"
#include "coverage/field/detail/patch.hpp"
#include "coverage/field/detail/simplify.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::coverage::detail {
namespace {

/// Borders are taken as straight where they deviate by no more than this share of the width.
constexpr double kStraight = 0.24;
constexpr double kShortest_m = 0.02;
constexpr std::size_t kMostTaken = 5;
/// Distances from a border at which it is flown along, of which one is tried at a time.
constexpr std::size_t kOffsets = 3;
constexpr std::size_t kDirections = 2;
/// How much better a candidate may look by chance.
constexpr double kNoise = 0.35;
/// Temperature at the start, as share of a piece's cost; it falls to nothing.
constexpr double kTemperature = 0.12;
/// Drawing lines in saves no more than so many pieces cost.
constexpr double kDrawnIn = 1.5;
constexpr double kBetter_m = 1e-6;
constexpr double kNothing_m2 = 1e-6;

/// A line to fly, and the ground that it sees.
struct Piece {
  Segment segment;
  Band band;
  Box box;
  std::vector<Patch> seen;
};
using PiecePtr = std::shared_ptr<const Piece>;

struct Cover {
  std::vector<PiecePtr> pieces;
  double lost_m2 = 0.0;
  double cost_m = 0.0;
};

/// A line that might be flown between two limits; `base`: it is that piece of the cover, drawn on.
struct Candidate {
  Line line;
  Interval limits;
  PiecePtr base;
  double most_m2 = 0.0;  ///< sees no more; without a base
  double noise = 1.0;
};

bool meet(const Piece& a, const Piece& b) {
  return (a.box.lo.array() < b.box.hi.array()).all() && (b.box.lo.array() < a.box.hi.array()).all() &&
         may_meet(a.band, b.band);
}

/// Between two segments, by their ends and middles: near enough to tell neighbours.
double apart(const Segment& a, const Segment& b) {
  const auto to = [](const Segment& s, const Vec2& p) {
    const Vec2 along = s.to_m - s.from_m;
    const double t = std::clamp((p - s.from_m).dot(along) / std::max(along.squaredNorm(), 1e-12), 0.0, 1.0);
    return (p - s.from_m - t * along).norm();
  };
  return std::min({to(a, b.from_m), to(a, b.to_m), to(b, a.from_m), to(b, a.to_m)});
}

/// Where a line runs inside the polygon.
struct Stretches {
  Line line;
  std::vector<Interval> inside;
};

class LineSearch {
 public:
  LineSearch(const Polygon& polygon, const LineSearchParams& params, const std::vector<Segment>& pieces)
      : polygon_(polygon), params_(params), ground_(patches_of(polygon)), rng_(params.seed) {
    add_borders(polygon.outline);
    for (const Ring& hole : polygon.holes) add_borders(hole);
    for (const Segment& segment : pieces) now_.pieces.push_back(piece_of(segment));
    now_.cost_m = cost_of(now_);
    best_ = now_;
  }

  double run(std::vector<Segment>& out);

 private:
  PiecePtr piece_of(const Segment& segment) const;
  double cost_of(const Cover& cover) const;
  void add_borders(const Ring& ring);
  std::vector<std::size_t> choose_taken();
  std::vector<Patch> seen_alone(const Piece& piece, const std::vector<PiecePtr>& others) const;
  std::optional<Cover> neighbour(double worse_m);
  bool recover(std::vector<Patch>& open, const std::vector<PiecePtr>& taken, double budget_m, Cover& cover);
  std::vector<Candidate> candidates(const std::vector<Patch>& open, const std::vector<PiecePtr>& taken,
                                    const Cover& cover);
  void add_line(const Line& line, const std::vector<Patch>& open, std::vector<Candidate>& out) {
    add_stretches({line, inside_of(polygon_, line)}, open, out);
  }
  /// Those of a line's stretches from which something open may be seen.
  void add_stretches(const Stretches& stretches, const std::vector<Patch>& open, std::vector<Candidate>& out);
  void add_direction(const Vec2& along, const std::vector<Patch>& open, std::vector<Candidate>& out);
  LineGain gain_of(const Candidate& candidate, const std::vector<Patch>& open) const;
  double most_rate(const Candidate& candidate, const std::vector<Patch>& open) const;
  void draw_in(Cover& cover, const std::vector<PiecePtr>& around) const;
  void draw_in_one(Cover& cover, std::size_t at) const;

  const Polygon& polygon_;
  LineSearchParams params_;
  std::vector<Patch> ground_;
  std::vector<Stretches> borders_;  ///< kOffsets of each stretch of border
  Rng rng_;
  Cover now_;
  Cover best_;
};

PiecePtr LineSearch::piece_of(const Segment& segment) const {
  auto out = std::make_shared<Piece>();
  out->segment = segment;
  out->band = band_of(segment, params_.width_m);
  out->box = bounds_of(coverage::detail::seen_from(segment, params_.width_m));
  out->seen = within(ground_, out->band);
  return out;
}

double LineSearch::cost_of(const Cover& cover) const {
  double cost = 0.0;
  for (const PiecePtr& piece : cover.pieces) cost += piece->segment.length_m() + params_.piece_cost_m;
  return cost;
}

/// Beside each straight stretch of border: as far from it as it is still seen, as near as the line stays
/// inside, and between.
void LineSearch::add_borders(const Ring& ring) {
  const std::vector<std::size_t> corners = corners_of(ring, kStraight * params_.width_m);
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
    const double farthest = params_.width_m / 2.0 + depth.from - kInside_m;
    const double nearest = std::min(depth.to + kInside_m, farthest);
    for (const double offset : {farthest, (nearest + farthest) / 2.0, nearest}) {
      const Line line{border.origin_m + inwards * offset, border.along};
      borders_.push_back({line, inside_of(polygon_, line)});
    }
  }
}

/// A piece and its nearest neighbours.
std::vector<std::size_t> LineSearch::choose_taken() {
  const std::size_t first = rng_.below(now_.pieces.size());
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < now_.pieces.size(); ++i) {
    const double distance =
        i == first ? -1.0
                   : apart(now_.pieces[first]->segment, now_.pieces[i]->segment) * rng_.uniform(0.7, 1.3);
    near.emplace_back(distance, i);
  }
  const std::size_t count = std::min<std::size_t>(near.size(), 2 + rng_.below(kMostTaken - 1));
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(near[i].second);
  return out;
}

std::vector<Patch> LineSearch::seen_alone(const Piece& piece, const std::vector<PiecePtr>& others) const {
  std::vector<Patch> left = piece.seen;
  for (const PiecePtr& other : others) {
    if (left.empty()) break;
    if (other.get() != &piece && meet(*other, piece)) subtract(other->band, left);
  }
  return left;
}

void LineSearch::add_stretches(const Stretches& stretches, const std::vector<Patch>& open,
                               std::vector<Candidate>& out) {
  for (const Interval& inside : stretches.inside) {
    const double most_m2 = area_near({stretches.line, inside, params_.width_m / 2.0}, open);
    if (most_m2 > 0.0) out.push_back({stretches.line, inside, nullptr, most_m2});
  }
}

/// Side by side from either end of what is open.
void LineSearch::add_direction(const Vec2& along, const std::vector<Patch>& open,
                               std::vector<Candidate>& out) {
  const Vec2 left(-along.y(), along.x());
  Interval across{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Patch& patch : open) {
    for (std::size_t i = 0; i < patch.size; ++i) {
      const double at = left.dot(patch.corners[i]);
      across = {std::min(across.from, at), std::max(across.to, at)};
    }
  }
  const double step = params_.width_m - 2.0 * kInside_m;
  const int count = std::clamp(static_cast<int>(std::ceil((across.to - across.from) / step)), 1, 12);
  for (int i = 0; i < count; ++i) {
    add_line({left * (across.from + (i + 0.5) * step), along}, open, out);
    if (count > 1) add_line({left * (across.to - (i + 0.5) * step), along}, open, out);
  }
}

std::vector<Candidate> LineSearch::candidates(const std::vector<Patch>& open,
                                              const std::vector<PiecePtr>& taken, const Cover& cover) {
  std::vector<Candidate> out;
  for (std::size_t i = 0; i < borders_.size(); i += kOffsets)
    add_stretches(borders_[i + rng_.below(kOffsets)], open, out);
  std::vector<Vec2> directions;
  for (const PiecePtr& piece : taken) {
    add_line(piece->band.line, open, out);
    directions.push_back(piece->band.line.along);
  }
  for (const PiecePtr& piece : cover.pieces) {
    const bool near =
        std::any_of(taken.begin(), taken.end(), [&](const PiecePtr& other) { return meet(*piece, *other); });
    if (!near) continue;
    directions.push_back(piece->band.line.along);
    // A line that grazes a corner may come out as two: neither is the piece drawn on.
    const double length = piece->segment.length_m();
    for (const Interval& inside : inside_of(polygon_, piece->band.line)) {
      if (inside.from > kBetter_m || inside.to < length - kBetter_m) continue;
      out.push_back({piece->band.line, {std::min(inside.from, 0.0), std::max(inside.to, length)}, piece});
    }
  }
  for (std::size_t i = 0; i < kDirections; ++i)
    add_direction(directions[rng_.below(directions.size())], open, out);
  for (Candidate& candidate : out) candidate.noise = 1.0 + kNoise * rng_.uniform();
  return out;
}

LineGain LineSearch::gain_of(const Candidate& candidate, const std::vector<Patch>& open) const {
  const LineInView view(candidate.line, candidate.limits, params_.width_m, open);
  return candidate.base != nullptr ? view.drawn_on(candidate.base->segment.length_m())
                                   : view.flown(params_.piece_cost_m);
}

/// No less than the gain's rate: for a piece of its own without a look at what exactly it sees.
double LineSearch::most_rate(const Candidate& candidate, const std::vector<Patch>& open) const {
  if (candidate.base != nullptr) return gain_of(candidate, open).rate;
  return candidate.most_m2 / (params_.piece_cost_m + candidate.most_m2 / params_.width_m);
}

/// Greedy; a candidate's gain only shrinks, so that those behind the best known need no second look. False
/// when it takes more than the budget, or must since none sees enough for its cost.
bool LineSearch::recover(std::vector<Patch>& open, const std::vector<PiecePtr>& taken, double budget_m,
                         Cover& cover) {
  std::vector<Candidate> all = candidates(open, taken, cover);
  std::vector<std::pair<double, std::size_t>> queue;
  double open_m2 = area_m2(open);
  for (std::size_t i = 0; i < all.size(); ++i) queue.emplace_back(most_rate(all[i], open) * all[i].noise, i);
  std::make_heap(queue.begin(), queue.end());
  while (!queue.empty() && cover.lost_m2 + open_m2 > params_.allowed_m2) {
    if (cover.lost_m2 + open_m2 - params_.allowed_m2 > budget_m * queue.front().first) return false;
    std::pop_heap(queue.begin(), queue.end());
    const auto [rate, at] = queue.back();
    queue.pop_back();
    Candidate& candidate = all[at];
    const LineGain gain = gain_of(candidate, open);
    const bool no_longer = candidate.base != nullptr && gain.stretch.to - gain.stretch.from <
                                                            candidate.base->segment.length_m() + kBetter_m;
    if (gain.rate <= 0.0 || no_longer || gain.stretch.to - gain.stretch.from < kShortest_m) continue;
    if (gain.rate * candidate.noise < rate * (1.0 - 1e-9)) {
      queue.emplace_back(gain.rate * candidate.noise, at);
      std::push_heap(queue.begin(), queue.end());
      continue;
    }
    const int strip = candidate.base != nullptr ? candidate.base->segment.strip : -1;
    const PiecePtr piece = piece_of(candidate.line.piece(gain.stretch, strip));
    if (candidate.base != nullptr) {
      budget_m -= piece->segment.length_m() - candidate.base->segment.length_m();
      std::replace(cover.pieces.begin(), cover.pieces.end(), candidate.base, piece);
      candidate.base = piece;
      candidate.limits = {candidate.limits.from - gain.stretch.from, candidate.limits.to - gain.stretch.from};
      candidate.line = piece->band.line;
    } else {
      budget_m -= piece->segment.length_m() + params_.piece_cost_m;
      cover.pieces.push_back(piece);
    }
    if (budget_m < 0.0) return false;
    const double before_m2 = open_m2;
    subtract(piece->band, open);
    open_m2 = area_m2(open);
    if (open_m2 > before_m2 - kNothing_m2) continue;
    queue.emplace_back(gain_of(candidate, open).rate * candidate.noise, at);
    std::push_heap(queue.begin(), queue.end());
  }
  cover.lost_m2 += open_m2;
  return cover.lost_m2 <= params_.allowed_m2;
}

void LineSearch::draw_in_one(Cover& cover, std::size_t at) const {
  const PiecePtr piece = cover.pieces[at];
  const std::vector<Patch> alone = seen_alone(*piece, cover.pieces);
  const double area = area_m2(alone);
  if (cover.lost_m2 + area <= params_.allowed_m2) {
    cover.lost_m2 += area;
    cover.pieces.erase(cover.pieces.begin() + static_cast<std::ptrdiff_t>(at));
    return;
  }
  Interval needed{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Patch& patch : alone) {
    for (std::size_t i = 0; i < patch.size; ++i) {
      const double s = piece->band.line.along_of(patch.corners[i]);
      needed = {std::min(needed.from, s), std::max(needed.to, s)};
    }
  }
  const double length = piece->segment.length_m();
  needed = {std::max(needed.from, 0.0), std::min(needed.to, length)};
  const double now = needed.to - needed.from;
  if (now > length - kShortest_m || now < kShortest_m) return;
  cover.pieces[at] = piece_of(piece->band.line.piece(needed, piece->segment.strip));
}

/// The new pieces, then what they meet; shortest first.
void LineSearch::draw_in(Cover& cover, const std::vector<PiecePtr>& around) const {
  std::vector<PiecePtr> touched;
  for (const PiecePtr& piece : cover.pieces) {
    const bool meets = std::any_of(around.begin(), around.end(),
                                   [&](const PiecePtr& other) { return meet(*piece, *other); });
    if (meets) touched.push_back(piece);
  }
  std::stable_sort(touched.begin(), touched.end(), [](const PiecePtr& a, const PiecePtr& b) {
    return a->segment.length_m() < b->segment.length_m();
  });
  for (const PiecePtr& piece : touched) {
    const auto at = std::find(cover.pieces.begin(), cover.pieces.end(), piece);
    draw_in_one(cover, static_cast<std::size_t>(at - cover.pieces.begin()));
  }
}

/// Takes a few lines away and covers what they saw again; nothing when that costs more than `worse_m` more.
std::optional<Cover> LineSearch::neighbour(double worse_m) {
  const std::vector<std::size_t> chosen = choose_taken();
  Cover next;
  next.lost_m2 = now_.lost_m2;
  std::vector<PiecePtr> taken;
  double budget_m = worse_m + kDrawnIn * params_.piece_cost_m;
  for (std::size_t i = 0; i < now_.pieces.size(); ++i) {
    const bool is_taken = std::find(chosen.begin(), chosen.end(), i) != chosen.end();
    (is_taken ? taken : next.pieces).push_back(now_.pieces[i]);
    if (is_taken) budget_m += now_.pieces[i]->segment.length_m() + params_.piece_cost_m;
  }
  std::vector<Patch> open;
  std::vector<PiecePtr> seeing = next.pieces;
  for (const PiecePtr& piece : taken) {
    const std::vector<Patch> alone = seen_alone(*piece, seeing);
    open.insert(open.end(), alone.begin(), alone.end());
    seeing.push_back(piece);
  }
  if (!recover(open, taken, budget_m, next)) return std::nullopt;
  std::vector<PiecePtr> around = taken;
  for (const PiecePtr& piece : next.pieces) {
    if (std::find(now_.pieces.begin(), now_.pieces.end(), piece) == now_.pieces.end())
      around.push_back(piece);
  }
  draw_in(next, around);
  next.cost_m = cost_of(next);
  if (next.cost_m > now_.cost_m + worse_m) return std::nullopt;
  return next;
}

double LineSearch::run(std::vector<Segment>& out) {
  for (int round = 0; round < params_.rounds && now_.pieces.size() > 1; ++round) {
    const double left = 1.0 - static_cast<double>(round) / params_.rounds;
    const double heat_m = kTemperature * params_.piece_cost_m * left;
    std::optional<Cover> next = neighbour(-heat_m * std::log(std::max(rng_.uniform(), 1e-12)));
    if (!next) continue;
    now_ = std::move(*next);
    if (now_.cost_m < best_.cost_m - kBetter_m) best_ = now_;
  }
  out.clear();
  for (const PiecePtr& piece : best_.pieces) out.push_back(piece->segment);
  return best_.lost_m2;
}

}  // namespace

double search_lines(const Polygon& polygon, const LineSearchParams& params, std::vector<Segment>& pieces) {
  if (pieces.size() < 2) return 0.0;
  return LineSearch(polygon, params, pieces).run(pieces);
}

}  // namespace swallowtail::coverage::detail
