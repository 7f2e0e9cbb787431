#pragma once

#include <vector>

#include "coverage/field/detail/line_cover.hpp"
#include "coverage/field/detail/line_gain.hpp"
#include "coverage/field/detail/ring_tree.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::coverage::detail {

/// A line that might be flown between two limits; `base`: it is that piece of the cover, drawn on.
struct Candidate {
  Line line;
  Interval limits;
  PiecePtr base;
  double most_m2 = 0.0;  ///< sees no more; without a base
  double noise = 1.0;    ///< makes it look better by chance
  LineInView view;
};

/// Where the lines are that may cover open ground of a polygon.
class CandidateLines {
 public:
  CandidateLines(const Polygon& polygon, double width_m);

  /// Along near borders, where lines were taken away, in the directions of near lines, and near lines drawn
  /// on. At least one line was taken.
  std::vector<Candidate> around(const OpenGround& open, const std::vector<PiecePtr>& taken,
                                const std::vector<PiecePtr>& kept, Rng& rng) const;
  Candidate drawn_on(const PiecePtr& base, const Interval& limits) const;

 private:
  /// Where a line runs inside the polygon.
  struct Stretches {
    Line line;
    std::vector<Interval> inside;
  };

  void add_borders(const Ring& ring);
  void add_line(const Line& line, const OpenGround& open, std::vector<Candidate>& out) const;
  /// Those of a line's stretches from which something open may be seen.
  void add_stretches(const Stretches& stretches, const OpenGround& open, std::vector<Candidate>& out) const;
  void add_direction(const Vec2& along, const OpenGround& open, std::vector<Candidate>& out) const;
  void add_drawn_on(const PiecePtr& piece, std::vector<Candidate>& out) const;

  RingTree rings_;
  double width_m_;
  std::vector<Stretches> borders_;  ///< kOffsets of each stretch of border
};

}  // namespace swallowtail::coverage::detail
