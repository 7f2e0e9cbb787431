#pragma once

#include <vector>

#include "coverage/field/detail/lines.hpp"
#include "coverage/field/polygon.hpp"
#include "coverage/field/sweep.hpp"

namespace swallowtail::coverage::detail {

/// The polygon cut at every place where strips along `sweep_rad` begin or cease to be split by a hole or a
/// notch [CHOSET]: within a cell each strip is one piece.
std::vector<Polygon> boustrophedon_cells(const Polygon& polygon, double sweep_rad);

struct CellLines {
  std::vector<Segment> pieces;  ///< numbered by strip
  int strips = 0;
};

/// Lines in a direction of their own for each cell of the polygon: of the cheapest directions of polygon and
/// cells the labelling whose lines cost least (length and piece_cost_m; a line that goes on through
/// neighbouring cells of one direction is one piece; a border between cells of different directions costs a
/// share of its length), by descent from each of the best single directions. Empty when there is one cell
/// only or no labelling beats a single direction. Departs from [BAHNEMANN]: directions are chosen before
/// the tour and not by it, since a tour over single strips takes more from a line that goes on than from a
/// better sweep of one cell.
CellLines lines_by_cell(const Polygon& polygon, const SweepParams& params);

}  // namespace swallowtail::coverage::detail
