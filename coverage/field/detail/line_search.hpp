#pragma once

#include <cstdint>
#include <vector>

#include "coverage/field/detail/line_tour.hpp"
#include "coverage/field/detail/lines.hpp"
#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage::detail {

struct LineSearchParams {
  double width_m = 10.0;       ///< of the sensor
  double piece_cost_m = 25.0;  ///< what one more piece is taken to cost before its place in the tour is known
  TurnCost turn{};
  double allowed_m2 = 0.0;  ///< may become uncovered
  std::uint64_t seed = 1;
  int rounds = 300;  ///< a round takes a few lines away and covers the ground again
};

/// Lines that cover the same ground as `pieces` at less cost: the length of a tour that flies them all, and
/// its stops. Whatever their direction: strips, lines along borders and lines drawn on are mixed as each
/// place wants. Ruin and recreate: a few neighbouring lines are taken away and what only they saw is covered
/// again by the lines that see most for their cost (along near borders, in the directions of near lines, or
/// by drawing a near line on), then all around is drawn in, and the tour takes up what has changed. Every
/// line stays inside the polygon. Pieces come back in the tour's order, each in the sense in which it is
/// flown; those that are kept keep their strip's number, new ones get −1. Returns what became uncovered, m².
/// Deterministic.
double search_lines(const Polygon& polygon, const LineSearchParams& params, std::vector<Segment>& pieces);

}  // namespace swallowtail::coverage::detail
