#include "coverage/field/detail/line_tour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swallowtail::coverage::detail {
namespace {

constexpr double kBetter_m = 1e-6;
/// Of an improvement, per leg.
constexpr std::size_t kMostSteps = 8;
/// Shorter ways are not asked for what is in their way: lines end so near to borders.
constexpr double kSurelyFree_m = 0.5;
/// What a blocked way costs more, as share of its length and of a stop.
constexpr double kDetourLength = 0.3;
constexpr double kDetourStops = 0.5;

bool is_convex(const Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2& at = ring[(i + 1) % ring.size()];
    if (cross(at - ring[i], ring[(i + 2) % ring.size()] - at) < 0.0) return false;
  }
  return true;
}

/// What a straight way between lines may cross.
std::vector<Ring> solids_of(const Polygon& polygon) {
  return is_convex(polygon.outline) ? polygon.holes : rings_of(polygon);
}

TourLeg turned_leg(const TourLeg& leg) { return {leg.line, leg.exit_m, leg.entry_m, -leg.along, 0.0}; }

}  // namespace

TourLeg leg_of(int line, const Segment& segment) {
  return {line, segment.from_m, segment.to_m, (segment.to_m - segment.from_m).normalized(), 0.0};
}

LinkCosts::LinkCosts(const Polygon& polygon, const TurnCost& turn)
    : stop_m_(turn.stop_m), least_cos_(std::cos(turn.turn_max_rad) - 1e-9), solids_(solids_of(polygon)) {}

double LinkCosts::link_m(const TourLeg& from, const TourLeg& to) const {
  const double length = (to.entry_m - from.exit_m).norm();
  if (length < kSurelyFree_m || !solids_.crosses(from.exit_m, to.entry_m)) return open_m(from, to);
  return (1.0 + kDetourLength) * length + (2.0 + kDetourStops) * stop_m_;
}

double LineTour::cost_m() const {
  double cost = 0.0;
  for (const TourLeg& leg : legs_) cost += (leg.exit_m - leg.entry_m).norm() + leg.link_m;
  return cost;
}

std::size_t LineTour::place_of(int line) const {
  const auto found =
      std::find_if(legs_.begin(), legs_.end(), [line](const TourLeg& leg) { return leg.line == line; });
  return static_cast<std::size_t>(found - legs_.begin());
}

TourLeg LineTour::turned(std::size_t at) const { return turned_leg(legs_[at]); }

/// What it costs to get from `before` to the first and from the last to `after`; something not below `most`
/// where that is so.
double LineTour::links_below(const TourLeg* before, const TourLeg& first, const TourLeg& last,
                             const TourLeg* after, double most_m) const {
  const double open_m = (before != nullptr ? costs_->open_m(*before, first) : 0.0) +
                        (after != nullptr ? costs_->open_m(last, *after) : 0.0);
  if (open_m >= most_m) return open_m;
  return (before != nullptr ? costs_->link_m(*before, first) : 0.0) +
         (after != nullptr ? costs_->link_m(last, *after) : 0.0);
}

void LineTour::relink(std::size_t at) {
  if (at >= legs_.size()) return;
  legs_[at].link_m = at + 1 < legs_.size() ? costs_->link_m(legs_[at], legs_[at + 1]) : 0.0;
}

void LineTour::remove(int line) {
  const std::size_t at = place_of(line);
  legs_.erase(legs_.begin() + static_cast<std::ptrdiff_t>(at));
  if (at > 0) {
    relink(at - 1);
    touched_.push_back(legs_[at - 1].line);
  }
}

void LineTour::replace(int line, const Segment& segment) {
  const std::size_t at = place_of(line);
  TourLeg leg = leg_of(line, segment);
  if (leg.along.dot(legs_[at].along) < 0.0) leg = turned_leg(leg);
  legs_[at] = leg;
  relink(at);
  if (at > 0) relink(at - 1);
  touched_.push_back(line);
}

void LineTour::insert(int line, const Segment& segment) {
  const TourLeg ways[2] = {leg_of(line, segment), turned_leg(leg_of(line, segment))};
  std::size_t best = 0;
  const TourLeg* as = &ways[0];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t at = 0; at <= legs_.size(); ++at) {
    const bool after = at > 0;
    const bool before = at < legs_.size();
    const double old = after ? legs_[at - 1].link_m : 0.0;
    for (const TourLeg& way : ways) {
      // Sums of squares first: two ways of a and b metres are no shorter than the root of a² + b².
      double squares = after ? (way.entry_m - legs_[at - 1].exit_m).squaredNorm() : 0.0;
      if (before) squares += (legs_[at].entry_m - way.exit_m).squaredNorm();
      const double most = least + old;
      if (squares >= most * most) continue;
      const double cost =
          links_below(after ? &legs_[at - 1] : nullptr, way, way, before ? &legs_[at] : nullptr, most);
      if (cost >= most) continue;
      least = cost - old;
      best = at;
      as = &way;
    }
  }
  legs_.insert(legs_.begin() + static_cast<std::ptrdiff_t>(best), *as);
  relink(best);
  if (best > 0) relink(best - 1);
  touched_.push_back(line);
}

/// Links stand with the leg they lead from; the two at the stretch's ends are left as they were.
void LineTour::turn(std::size_t from, std::size_t past) {
  const auto at = [this](std::size_t i) { return legs_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::reverse(at(from), at(past));
  for (std::size_t i = from; i < past; ++i) {
    const double link = i + 1 < past ? legs_[i + 1].link_m : 0.0;
    legs_[i] = turned_leg(legs_[i]);
    legs_[i].link_m = link;
  }
}

/// Turns what lies between the leg at `before` − 1 and another, on either side of it.
bool LineTour::turn_stretch(std::size_t before) {
  const std::size_t size = legs_.size();
  const double here_m = before > 0 ? legs_[before - 1].link_m : 0.0;
  for (std::size_t other = 0; other <= size; ++other) {
    if (other == before) continue;
    const std::size_t from = std::min(before, other);
    const std::size_t past = std::max(before, other);
    const double old = here_m + (other > 0 ? legs_[other - 1].link_m : 0.0);
    double squares = from > 0 ? (legs_[from - 1].exit_m - legs_[past - 1].exit_m).squaredNorm() : 0.0;
    if (past < size) squares += (legs_[from].entry_m - legs_[past].entry_m).squaredNorm();
    if (squares >= old * old) continue;
    const double most = old - kBetter_m;
    const double cost = links_below(from > 0 ? &legs_[from - 1] : nullptr, turned(past - 1), turned(from),
                                    past < size ? &legs_[past] : nullptr, most);
    if (cost >= most) continue;
    turn(from, past);
    if (from > 0) relink(from - 1);
    relink(past - 1);
    return true;
  }
  return false;
}

bool LineTour::move_chain(std::size_t first, std::size_t count) {
  const std::size_t size = legs_.size();
  const std::size_t past = first + count;
  const bool between = first > 0 && past < size;
  const double saved = (first > 0 ? legs_[first - 1].link_m : 0.0) + legs_[past - 1].link_m;
  if (saved < kBetter_m) return false;
  const double closed = between ? costs_->link_m(legs_[first - 1], legs_[past]) : 0.0;
  if (saved - closed < kBetter_m) return false;
  const TourLeg heads[2] = {legs_[first], turned(past - 1)};
  const TourLeg tails[2] = {legs_[past - 1], turned(first)};
  for (std::size_t to = 0; to <= size; ++to) {
    if (to >= first && to <= past) continue;
    const double most = saved - closed - kBetter_m + (to > 0 ? legs_[to - 1].link_m : 0.0);
    for (const int way : {0, 1}) {
      double squares = to > 0 ? (heads[way].entry_m - legs_[to - 1].exit_m).squaredNorm() : 0.0;
      if (to < size) squares += (legs_[to].entry_m - tails[way].exit_m).squaredNorm();
      if (squares >= most * most) continue;
      const double cost = links_below(to > 0 ? &legs_[to - 1] : nullptr, heads[way], tails[way],
                                      to < size ? &legs_[to] : nullptr, most);
      if (cost >= most) continue;
      if (way == 1) turn(first, past);
      const auto at = [this](std::size_t i) { return legs_.begin() + static_cast<std::ptrdiff_t>(i); };
      if (to < first) {
        std::rotate(at(to), at(first), at(past));
        for (const std::size_t i : {to - 1, to + count - 1, past - 1}) relink(i);
      } else {
        std::rotate(at(first), at(past), at(to));
        for (const std::size_t i : {first - 1, to - count - 1, to - 1}) relink(i);
      }
      return true;
    }
  }
  return false;
}

bool LineTour::improve_at(std::size_t at) {
  if (turn_stretch(at) || turn_stretch(at + 1)) return true;
  for (std::size_t count = 1; count <= kMostMoved; ++count) {
    const std::size_t least = at + 1 >= count ? at + 1 - count : 0;
    for (std::size_t first = least; first <= at && first + count <= legs_.size(); ++first) {
      if (move_chain(first, count)) return true;
    }
  }
  return false;
}

void LineTour::improve() {
  // Ways that graze a border may be free one way round only, so that two tours seem better than each other.
  std::size_t steps = kMostSteps * (legs_.size() + 1);
  while (!touched_.empty() && steps-- > 0) {
    const int line = touched_.back();
    const std::size_t at = place_of(line);
    if (at == legs_.size() || !improve_at(at)) touched_.pop_back();
  }
  touched_.clear();
}

}  // namespace swallowtail::coverage::detail
