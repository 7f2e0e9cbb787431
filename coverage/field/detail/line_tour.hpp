#pragma once

#include <vector>

#include "coverage/field/detail/lines.hpp"
#include "coverage/field/detail/ring_tree.hpp"
#include "coverage/field/polygon.hpp"
#include "coverage/field/turn_cost.hpp"

namespace swallowtail::coverage::detail {

/// A line of the tour, the way it is flown.
struct TourLeg {
  int line = 0;  ///< the caller's number for it
  Vec2 entry_m = Vec2::Zero();
  Vec2 exit_m = Vec2::Zero();
  Vec2 along = Vec2::Zero();
  double link_m = 0.0;  ///< kept by LineTour: what it costs to get to the next leg
};
TourLeg leg_of(int line, const Segment& segment);

/// What it costs to get from line to line: the straight way, and a stop where it turns sharply. A way that
/// is blocked counts as one with two stops and a detour; how it bends is left to the planner of the order.
class LinkCosts {
 public:
  LinkCosts(const Polygon& polygon, const TurnCost& turn);
  double link_m(const TourLeg& from, const TourLeg& to) const;
  /// As if nothing were in the way: no more than link_m.
  double open_m(const TourLeg& from, const TourLeg& to) const {
    const Vec2 way = to.entry_m - from.exit_m;
    const double length = way.norm();
    if (length < kSamePlace_m) return from.along.dot(to.along) < least_cos_ ? stop_m_ : 0.0;
    const double least = least_cos_ * length;
    const int stops = (from.along.dot(way) < least ? 1 : 0) + (to.along.dot(way) < least ? 1 : 0);
    return length + stops * stop_m_;
  }

 private:
  static constexpr double kSamePlace_m = 1e-6;

  double stop_m_;
  double least_cos_;
  RingTree solids_;
};

/// An open tour over lines, each flown once, from any end of any to any other. It stays near a local optimum
/// while lines come, go and change.
class LineTour {
 public:
  explicit LineTour(const LinkCosts& costs) : costs_(&costs) {}

  const std::vector<TourLeg>& legs() const { return legs_; }
  /// Lengths and links.
  double cost_m() const;
  void remove(int line);
  /// Keeps its place and sense.
  void replace(int line, const Segment& segment);
  /// Where it costs least.
  void insert(int line, const Segment& segment);
  /// Turns stretches round and moves chains of up to kMostMoved lines, around all lines that have come or
  /// changed, and where some have gone, since it was called last.
  void improve();

 private:
  static constexpr std::size_t kMostMoved = 3;

  TourLeg turned(std::size_t at) const;
  void turn(std::size_t from, std::size_t past);
  void relink(std::size_t at);
  double links_below(const TourLeg* before, const TourLeg& first, const TourLeg& last, const TourLeg* after,
                     double most_m) const;
  bool improve_at(std::size_t at);
  bool turn_stretch(std::size_t before);
  bool move_chain(std::size_t first, std::size_t count);
  std::size_t place_of(int line) const;

  const LinkCosts* costs_;
  std::vector<TourLeg> legs_;
  std::vector<int> touched_;
};

}  // namespace swallowtail::coverage::detail
