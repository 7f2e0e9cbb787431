#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "coverage/field/polygon.hpp"
#include "coverage/field/turn_cost.hpp"

namespace swallowtail::coverage {

/// Whether lines may leave the field where they cover a slanted border (never over holes or no-fly areas).
enum class Beyond : std::uint8_t { kNever, kSlantedBorders };

struct StripParams {
  double sensor_width_m = 10.0;
  double overlap = 0.0;  ///< share of the sensor's width that neighbouring strips see both, 0 … 0.9
  std::optional<double>
      sweep_rad{};  ///< flying direction, counter-clockwise from east; without it the cheapest is chosen
  double piece_cost_m = 25.0;  ///< see SweepParams
  TurnCost turn{};             ///< weighs lines of mixed direction by the tour that flies them
  double headland_m = 0.0;     ///< width of a band along the border that is flown along it, before the strips
  Beyond beyond = Beyond::kNever;
  std::vector<Polygon> closed{};  ///< which no line enters beyond a border, besides the polygon's holes
};
Status validate(const StripParams& params);

/// A line to fly once from end to end; what lies within half a sensor width of it is covered.
struct Piece {
  Vec2 from_m = Vec2::Zero();
  Vec2 to_m = Vec2::Zero();
  int strip = 0;  ///< pieces along borders have numbers of their own, after the strips'
};

struct Strips {
  double sweep_rad = 0.0;
  int count = 0;
  double width_m = 0.0;  ///< of each strip, ≤ the sensor's
  std::vector<Piece> pieces;
  double uncovered_m2 = 0.0;  ///< what no line inside the field sees, or what is too little to be worth one
};

inline constexpr int kMaxStrips = 4096;
/// What may stay uncovered for want of being worth a line, as share of the field.
inline constexpr double kUncoveredShare = 2e-4;

/// Boustrophedon strips [COV 3] [CHOSET]: the field is cut perpendicular to the sweep direction into equal
/// strips of at most one sensor width, and each stretch of a strip's centre line inside the field is flown.
/// What the strips leave over along slanted borders, beside holes and in tips is covered by lines along the
/// borders; then pieces are drawn in, or left out, where others see the same ground. No line leaves the field
/// or crosses a hole (with Beyond::kSlantedBorders lines are instead prolonged over a slanted border, by what
/// half a sensor sideways asks for). Without a given direction the three that promise most are cut, the
/// cheapest is taken, and its lines are then mixed with such of other directions as each place wants
/// (detail/line_search.hpp; not with a headland that is flown, nor with lines beyond borders). `polygon` must
/// be clean. Errors (kBadInput): params; more than kMaxStrips strips. (kInternal): GEOS failed.
/// Departs from [COV]: strips are spread evenly, so that the last is neither missing nor half outside, and
/// borders get lines of their own. Departs from [BAHNEMANN]: directions are not chosen by the tour over cells
/// but line by line before it: by cells less than 0.3 % was gained over one direction, by lines 2 to 14 %.
Result<Strips> cut_strips(const Polygon& polygon, const StripParams& params);

}  // namespace swallowtail::coverage
