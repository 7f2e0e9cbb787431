#include "coverage/field/detail/line_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "coverage/field/detail/line_candidates.hpp"
#include "coverage/field/detail/line_cover.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::coverage::detail {
namespace {

constexpr double kShortest_m = 0.02;
constexpr std::uint64_t kMostTaken = 3;
/// How often the lines taken away follow one another in the tour, instead of lying near.
constexpr double kTakenInTour = 0.6;
/// Temperature at the start, as share of a piece's cost; it falls to nothing.
constexpr double kTemperature = 0.3;
/// Finding lines a place in the tour and drawing them in saves no more than so many pieces cost.
constexpr double kSaved = 5.0;
/// What it costs to lose a square metre, though it may be lost: no gap pays only for being somewhat nearer.
constexpr double kLost_m = 10.0;
constexpr double kBetter_m = 1e-6;
constexpr double kNothing_m2 = 1e-6;

struct Cover {
  std::vector<PiecePtr> pieces;
  LineTour tour;
  double lost_m2 = 0.0;
  double cost_m = 0.0;
};

std::vector<PiecePtr>::const_iterator piece_in(const Cover& cover, int number) {
  return std::find_if(cover.pieces.begin(), cover.pieces.end(),
                      [&](const PiecePtr& piece) { return piece->number == number; });
}

double cost_of(const Cover& cover) { return cover.tour.cost_m() + kLost_m * cover.lost_m2; }

class LineSearch {
 public:
  LineSearch(const Polygon& polygon, const LineSearchParams& params, const std::vector<Segment>& pieces);

  double run(std::vector<Segment>& out);

 private:
  std::vector<PiecePtr> choose_taken();
  std::vector<PiecePtr> flown_with(const Piece& first, std::size_t count) const;
  std::vector<PiecePtr> nearest_to(const Piece& first, std::size_t count);
  std::optional<Cover> neighbour(double worse_m);
  OpenGround opened_by(const std::vector<PiecePtr>& taken, const std::vector<PiecePtr>& kept) const;
  bool recover(OpenGround open, const std::vector<PiecePtr>& taken, double budget_m, Cover& cover);
  PiecePtr fly(Candidate& candidate, const Interval& stretch, Cover& cover);
  LineGain gain_of(Candidate& candidate, const OpenGround& open) const;
  double most_rate(Candidate& candidate, const OpenGround& open) const;
  void draw_in(Cover& cover, const std::vector<PiecePtr>& around) const;
  void draw_in_one(Cover& cover, const PiecePtr& piece) const;

  LineSearchParams params_;
  Ground ground_;
  CandidateLines lines_;
  LinkCosts costs_;
  Rng rng_;
  int numbers_ = 0;
  Cover now_{{}, LineTour(costs_)};
};

LineSearch::LineSearch(const Polygon& polygon, const LineSearchParams& params,
                       const std::vector<Segment>& pieces)
    : params_(params),
      ground_(polygon, params.width_m),
      lines_(polygon, params.width_m),
      costs_(polygon, params.turn),
      rng_(params.seed) {
  for (const Segment& segment : pieces) {
    now_.pieces.push_back(ground_.piece_of(segment, numbers_++));
    now_.tour.insert(now_.pieces.back()->number, segment);
  }
  draw_in(now_, now_.pieces);
  now_.tour.improve();
  now_.cost_m = cost_of(now_);
}

/// The shorter of two: it costs more for what it sees. With it its nearest, or those flown after it.
std::vector<PiecePtr> LineSearch::choose_taken() {
  const std::vector<PiecePtr>& all = now_.pieces;
  const PiecePtr& one = all[rng_.below(all.size())];
  const PiecePtr& other = all[rng_.below(all.size())];
  const Piece& first = other->segment.length_m() < one->segment.length_m() ? *other : *one;
  const std::size_t count = std::min(all.size(), 2 + rng_.below(kMostTaken - 1));
  return rng_.uniform() < kTakenInTour ? flown_with(first, count) : nearest_to(first, count);
}

std::vector<PiecePtr> LineSearch::flown_with(const Piece& first, std::size_t count) const {
  const std::vector<TourLeg>& legs = now_.tour.legs();
  const auto place =
      std::find_if(legs.begin(), legs.end(), [&](const TourLeg& leg) { return leg.line == first.number; });
  const std::size_t from = std::min(static_cast<std::size_t>(place - legs.begin()), legs.size() - count);
  std::vector<PiecePtr> out;
  for (std::size_t i = from; i < from + count; ++i) out.push_back(*piece_in(now_, legs[i].line));
  return out;
}

std::vector<PiecePtr> LineSearch::nearest_to(const Piece& first, std::size_t count) {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < now_.pieces.size(); ++i) {
    const Piece& piece = *now_.pieces[i];
    const double distance =
        &piece == &first ? -1.0 : apart_m(first.segment, piece.segment) * rng_.uniform(0.7, 1.3);
    near.emplace_back(distance, i);
  }
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
  std::vector<PiecePtr> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(now_.pieces[near[i].second]);
  return out;
}

LineGain LineSearch::gain_of(Candidate& candidate, const OpenGround& open) const {
  candidate.view.look(open);
  return candidate.base != nullptr ? candidate.view.drawn_on(candidate.base->segment.length_m())
                                   : candidate.view.flown(params_.piece_cost_m);
}

/// No less than the gain's rate: for a piece of its own without a look at what exactly it sees.
double LineSearch::most_rate(Candidate& candidate, const OpenGround& open) const {
  if (candidate.base != nullptr) return gain_of(candidate, open).rate;
  return candidate.most_m2 / (params_.piece_cost_m + candidate.most_m2 / params_.width_m);
}

/// The candidate becomes the piece that is flown, to be drawn on, or is of the same line still.
PiecePtr LineSearch::fly(Candidate& candidate, const Interval& stretch, Cover& cover) {
  if (candidate.base == nullptr) {
    const PiecePtr piece = ground_.piece_of(candidate.line.piece(stretch, -1), numbers_++);
    cover.pieces.push_back(piece);
    cover.tour.insert(piece->number, piece->segment);
    return piece;
  }
  const Segment segment = candidate.line.piece(stretch, candidate.base->segment.strip);
  const PiecePtr piece = ground_.piece_of(segment, candidate.base->number);
  std::replace(cover.pieces.begin(), cover.pieces.end(), candidate.base, piece);
  cover.tour.replace(piece->number, segment);
  const double noise = candidate.noise;
  candidate =
      lines_.drawn_on(piece, {candidate.limits.from - stretch.from, candidate.limits.to - stretch.from});
  candidate.noise = noise;
  return piece;
}

/// Greedy; a candidate's gain only shrinks, so that those behind the best known need no second look. False
/// when it takes more than the budget, or must since none sees enough for its cost.
bool LineSearch::recover(OpenGround open, const std::vector<PiecePtr>& taken, double budget_m, Cover& cover) {
  std::vector<Candidate> all = lines_.around(open, taken, cover.pieces, rng_);
  std::vector<std::pair<double, std::size_t>> queue;
  double open_m2 = open.area_m2();
  for (std::size_t i = 0; i < all.size(); ++i) queue.emplace_back(most_rate(all[i], open) * all[i].noise, i);
  std::make_heap(queue.begin(), queue.end());
  while (!queue.empty() && cover.lost_m2 + open_m2 > params_.allowed_m2) {
    if (cover.lost_m2 + open_m2 - params_.allowed_m2 > budget_m * queue.front().first) return false;
    std::pop_heap(queue.begin(), queue.end());
    const auto [rate, at] = queue.back();
    queue.pop_back();
    Candidate& candidate = all[at];
    const LineGain gain = gain_of(candidate, open);
    const double length_m = gain.stretch.to - gain.stretch.from;
    const double before_m = candidate.base != nullptr ? candidate.base->segment.length_m() : 0.0;
    if (gain.rate <= 0.0 || length_m < std::max(kShortest_m, before_m + kBetter_m)) continue;
    if (gain.rate * candidate.noise < rate * (1.0 - 1e-9)) {
      queue.emplace_back(gain.rate * candidate.noise, at);
      std::push_heap(queue.begin(), queue.end());
      continue;
    }
    budget_m -= length_m - before_m + (candidate.base != nullptr ? 0.0 : params_.piece_cost_m);
    if (budget_m < 0.0) return false;
    const PiecePtr piece = fly(candidate, gain.stretch, cover);
    const double seen_m2 = open_m2;
    open.subtract(piece->band);
    open_m2 = open.area_m2();
    if (open_m2 > seen_m2 - kNothing_m2) continue;
    queue.emplace_back(gain_of(candidate, open).rate * candidate.noise, at);
    std::push_heap(queue.begin(), queue.end());
  }
  cover.lost_m2 += open_m2;
  return cover.lost_m2 <= params_.allowed_m2;
}

void LineSearch::draw_in_one(Cover& cover, const PiecePtr& piece) const {
  const auto at = std::find(cover.pieces.begin(), cover.pieces.end(), piece);
  const Needed needed = needed_of(*piece, cover.pieces, params_.allowed_m2 - cover.lost_m2);
  if (needed.is_nothing) {
    cover.lost_m2 += needed.alone_m2;
    cover.tour.remove(piece->number);
    cover.pieces.erase(at);
    return;
  }
  const double length = piece->segment.length_m();
  const Interval stretch{std::max(needed.stretch.from, 0.0), std::min(needed.stretch.to, length)};
  const double drawn_m = stretch.to - stretch.from;
  if (drawn_m > length - kShortest_m || drawn_m < kShortest_m) return;
  *at = ground_.part_of(*piece, stretch);
  cover.tour.replace(piece->number, (*at)->segment);
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
  for (const PiecePtr& piece : touched) draw_in_one(cover, piece);
}

/// What only lines that are taken away saw.
OpenGround LineSearch::opened_by(const std::vector<PiecePtr>& taken,
                                 const std::vector<PiecePtr>& kept) const {
  std::vector<Patch> open;
  std::vector<PiecePtr> seeing = kept;
  for (const PiecePtr& piece : taken) {
    const std::vector<Patch> alone = seen_alone(*piece, seeing);
    open.insert(open.end(), alone.begin(), alone.end());
    seeing.push_back(piece);
  }
  return OpenGround(std::move(open));
}

/// Takes a few lines away and covers what they saw again; nothing when that costs more than `worse_m` more.
std::optional<Cover> LineSearch::neighbour(double worse_m) {
  const std::vector<PiecePtr> taken = choose_taken();
  Cover next{{}, now_.tour, now_.lost_m2};
  double budget_m = worse_m + kSaved * params_.piece_cost_m;
  for (const PiecePtr& piece : now_.pieces) {
    if (std::find(taken.begin(), taken.end(), piece) == taken.end()) next.pieces.push_back(piece);
  }
  for (const PiecePtr& piece : taken) {
    budget_m += piece->segment.length_m() + params_.piece_cost_m;
    next.tour.remove(piece->number);
  }
  const std::vector<PiecePtr> kept = next.pieces;
  if (!recover(opened_by(taken, kept), taken, budget_m, next)) return std::nullopt;
  std::vector<PiecePtr> around;
  std::copy_if(
      next.pieces.begin(), next.pieces.end(), std::back_inserter(around),
      [&](const PiecePtr& piece) { return std::find(kept.begin(), kept.end(), piece) == kept.end(); });
  draw_in(next, around);
  next.tour.improve();
  next.cost_m = cost_of(next);
  if (next.cost_m > now_.cost_m + worse_m) return std::nullopt;
  return next;
}

double LineSearch::run(std::vector<Segment>& out) {
  Cover best = now_;
  for (int round = 0; round < params_.rounds && now_.pieces.size() > 1; ++round) {
    const double left = 1.0 - static_cast<double>(round) / params_.rounds;
    const double heat_m = kTemperature * params_.piece_cost_m * left;
    std::optional<Cover> next = neighbour(-heat_m * std::log(std::max(rng_.uniform(), 1e-12)));
    if (!next) continue;
    now_ = std::move(*next);
    if (now_.cost_m < best.cost_m - kBetter_m) best = now_;
  }
  out.clear();
  for (const TourLeg& leg : best.tour.legs()) {
    out.push_back({leg.entry_m, leg.exit_m, (*piece_in(best, leg.line))->segment.strip});
  }
  return best.lost_m2;
}

}  // namespace

double search_lines(const Polygon& polygon, const LineSearchParams& params, std::vector<Segment>& pieces) {
  if (pieces.size() < 2) return 0.0;
  return LineSearch(polygon, params, pieces).run(pieces);
}

}  // namespace swallowtail::coverage::detail
