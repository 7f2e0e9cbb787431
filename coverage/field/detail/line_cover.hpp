#pragma once

#include <memory>
#include <vector>

#include "coverage/field/detail/patch.hpp"

namespace swallowtail::coverage::detail {

/// A line to fly, and the ground that it sees.
struct Piece {
  int number = 0;  ///< stays its own however it is drawn on or in
  Segment segment;
  Band band;
  Planes planes{};
  Box box;
  std::vector<Patch> seen;
  std::vector<Interval> extents;  ///< of `seen`, along the line
};
using PiecePtr = std::shared_ptr<const Piece>;

/// Whether two may see the same ground.
bool meet(const Piece& a, const Piece& b);
/// Between two segments, by their ends: near enough to tell neighbours.
double apart_m(const Segment& a, const Segment& b);

/// The ground of a polygon under a sensor.
class Ground {
 public:
  Ground(const Polygon& polygon, double width_m) : patches_(patches_of(polygon)), width_m_(width_m) {}
  PiecePtr piece_of(const Segment& segment, int number) const;
  /// A piece drawn in to a stretch of it.
  PiecePtr part_of(const Piece& piece, const Interval& stretch) const;

 private:
  PiecePtr piece_over(const std::vector<Patch>& patches, const Segment& segment, int number) const;

  std::vector<Patch> patches_;
  double width_m_;
};

/// What of a piece's ground none of the others sees.
std::vector<Patch> seen_alone(const Piece& piece, const std::vector<PiecePtr>& others);

/// How far a piece may be drawn in for what it alone sees.
struct Needed {
  bool is_nothing = false;  ///< it sees no more than may be lost
  Interval stretch;         ///< by distance along the piece
  double alone_m2 = 0.0;    ///< exact where it is needed for nothing
};
Needed needed_of(const Piece& piece, const std::vector<PiecePtr>& others, double may_lose_m2);

}  // namespace swallowtail::coverage::detail
