#pragma once

#include <vector>

#include "coverage/field/detail/patch.hpp"

namespace swallowtail::coverage::detail {

/// The stretch of a line that sees most for its cost.
struct LineGain {
  double rate = 0.0;  ///< area seen per metre of cost
  Interval stretch;
};

/// What is seen of open ground from a line between two limits.
class LineInView {
 public:
  LineInView(const Line& line, const Interval& limits, double width_m, const std::vector<Patch>& open);

  /// As a piece of its own; what lies farther apart than a piece costs makes two.
  LineGain flown(double piece_cost_m) const;
  /// As a piece from 0 to `length_m` that is there anyway, drawn on at one of its ends; the stretch includes
  /// the piece.
  LineGain drawn_on(double length_m) const;

 private:
  LineGain limited(LineGain gain) const;

  struct Seen {
    Interval extent;
    double area_m2;
  };
  Interval limits_;
  std::vector<Seen> seen_;  ///< by where it begins
};

}  // namespace swallowtail::coverage::detail
