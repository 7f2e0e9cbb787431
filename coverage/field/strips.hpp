#pragma once

#include <optional>
#include <vector>

#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage {

struct StripParams {
  double sensor_width_m = 10.0;
  std::optional<double>
      sweep_rad{};  ///< flying direction, counter-clockwise from east; without it the cheapest is chosen
  double piece_cost_m = 25.0;  ///< see SweepParams
};
Status validate(const StripParams& params);

/// A line to fly once from end to end; what lies within half a sensor width of it is covered.
struct Piece {
  Vec2 from_m = Vec2::Zero();
  Vec2 to_m = Vec2::Zero();
  int strip = 0;
};

struct Strips {
  double sweep_rad = 0.0;
  int count = 0;
  double width_m = 0.0;  ///< of each strip, ≤ the sensor's
  std::vector<Piece> pieces;
};

inline constexpr int kMaxStrips = 4096;

/// Boustrophedon strips [COV 3]: the field is cut perpendicular to the sweep direction into equal strips of
/// at most one sensor width; each connected part of field and strip is flown along the strip's centre line
/// over the part's full extent, so that slanted borders are covered too. Where a hole, or a notch wider than
/// half a sensor, lies on the centre line without reaching through the strip, the line ends at it and what is
/// left beside it gets its own line: no line passes over a hole, except over a slanted border by less than
/// half a sensor width sideways. `polygon` must be clean. Errors (kBadInput): more than kMaxStrips strips.
/// Departs from [COV]: strips are spread evenly, so that the last is neither missing nor half outside.
Result<Strips> cut_strips(const Polygon& polygon, const StripParams& params);

}  // namespace swallowtail::coverage
