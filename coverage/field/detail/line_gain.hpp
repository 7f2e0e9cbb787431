#pragma once

#include <vector>

#include "coverage/field/detail/patch.hpp"

namespace swallowtail::coverage::detail {

/// The stretch of a line that sees most for its cost.
struct LineGain {
  double rate = 0.0;  ///< area seen per metre of cost
  Interval stretch;
};

/// What is seen of open ground from a line between two limits. It remembers what it saw: looking again takes
/// only what has changed.
class LineInView {
 public:
  LineInView(const Line& line, const Interval& limits, double width_m);

  void look(const OpenGround& ground);
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
    std::size_t patch;
  };
  Band band_;
  Interval limits_;
  std::size_t looked_ = 0;  ///< patches of the ground
  std::vector<Seen> seen_;  ///< by where it begins
};

}  // namespace swallowtail::coverage::detail
